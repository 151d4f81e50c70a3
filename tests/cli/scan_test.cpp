// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scans with the real OpenNI2 library, the virtual sensor's driver and the virtual lamps.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "capture/rig.h"
#include "stack/stack_io.h"
#include "tests/cli/small_virtual_rig.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

/// The same with a calibration of its own, so that the sensor's registration stays off: its depth camera stands 25 mm to the
/// right of the colour camera.
fs::path unregistered_rig(const TemporaryFolder& home) {
  const fs::path rig = small_virtual_rig(home);
  for (const std::string stream : {"color", "depth"})
    replace_in_file(rig, stream + " = { width = 320, height = 240",
                    stream + " = { width = 160, height = 120");
  set_text(rig,
           text_of(rig) + "T_color_depth = [[1, 0, 0, 0.025], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]\n");
  return rig;
}

/// What a scan of that rig keeps when all is well: dark, 15 lamps, the colour shot, dark.
std::size_t whole_scan() { return virtual_rig().lamps.size() + 3; }

std::size_t color_images(const LightStack& stack) {
  std::size_t count = 0;
  for (const Frame& frame : stack.frames) count += frame.color.empty() ? 0U : 1U;
  return count;
}

void expect_whole(const fs::path& folder) {
  const Ran verified = run({"verify", folder});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  EXPECT_EQ(color_images(read_stack(folder)), whole_scan());
  EXPECT_FALSE(fs::exists(folder / "scan.json"));
}

/// Images that an unfinished scan says it has.
std::size_t images_so_far(const fs::path& folder) {
  if (!fs::exists(folder / "scan.json")) return 0;
  std::size_t count = 0;
  const json state = json::parse(text_of(folder / "scan.json"));
  for (const json& frame : state["frames"]) { count += frame.contains("color") ? 1U : 0U; }
  return count;
}

TEST(Scan, WritesAStackThatVerifiesWithItsTruthAndRefinesIt) {
  const TemporaryFolder home;
  const Ran ran = run({"scan", "--rig", small_virtual_rig(home), "-o", home / "scan", "--mask", "auto",
                       "--refine", home / "out", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json report = json::parse(ran.out);
  EXPECT_EQ(report["faults"], json::array()) << "a rig without faults";
  EXPECT_LT(report["saturated_share"], 0.01);
  expect_whole(home / "scan");
  EXPECT_TRUE(fs::exists(home / "out/before_after.png"));
  const Ran evaluated = run({"evaluate", home / "out", "--truth", home / "scan", "--json"});
  EXPECT_EQ(evaluated.exit_code, 0) << evaluated.err;
}

TEST(Scan, DepthThatTheSensorDoesNotRegisterIsRefinedByTheRigsCalibration) {
  const TemporaryFolder home;
  const Ran ran = run({"scan", "--rig", unregistered_rig(home), "-o", home / "scan", "--mask", "auto",
                       "--refine", home / "out"});
  ASSERT_TRUE(ran.exit_code == 0 || ran.exit_code == 7) << ran.err;
  EXPECT_DOUBLE_EQ(read_stack(home / "scan").T_color_depth(0, 3), 0.025);
  const Ran evaluated = run({"evaluate", home / "out", "--truth", home / "scan", "--json"});
  ASSERT_EQ(evaluated.exit_code, 0) << evaluated.err;
  const json errors = json::parse(evaluated.out);
  // Registered by the device: 2.4 mm and 8.0 degrees; with the baseline's sign the wrong way round: 21 mm, 16.5 degrees.
  EXPECT_LT(errors["rmse_mm"], 5);
  EXPECT_LT(errors["median_deg"], 11);
}

TEST(Scan, RefusesARecordingAsItsSensorBeforeItTouchesALamp) {
  const TemporaryFolder home;
  fs::create_directory(home / "old-scan");
  set_text(home / "rig.toml", "[sensor]\nuri = \"" + (home / "old-scan").string() +
                                  "\"\n[[lamps]]\nid = \"a\"\nchip = \"no such chip\"\noffset = 0\n");
  const Ran ran = run({"scan", "--rig", home / "rig.toml", "-o", home / "scan"});
  EXPECT_EQ(ran.exit_code, 2) << ran.err;
  EXPECT_THAT(ran.err, AllOf(HasSubstr("is the recording"), HasSubstr("rakelight import oni")));
  EXPECT_FALSE(fs::exists(home / "scan"));
}

TEST(Scan, NamesTheLampsThatDoNotWork) {
  const TemporaryFolder home;
  const fs::path rig = small_virtual_rig(home);
  replace_in_file(rig, "stuck_off = []", "stuck_off = [\"white-03\"]");
  replace_in_file(rig, "dim = []", "dim = [\"white-06\"]");
  replace_in_file(rig, "swapped = []", "swapped = [[\"white-01\", \"white-08\"]]");
  const Ran ran = run({"scan", "--rig", rig, "-o", home / "scan", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  std::vector<std::string> named;
  const json report = json::parse(ran.out);
  for (const json& fault : report["faults"]) {
    named.push_back(fault["kind"].get<std::string>() + " " + fault["lamp"].get<std::string>() +
                    (fault.contains("other") ? " " + fault["other"].get<std::string>() : ""));
  }
  EXPECT_THAT(
      named, testing::UnorderedElementsAre("no-light white-03", "dim white-06", "swapped white-01 white-08"));
  EXPECT_THAT(ran.err, HasSubstr("lamp 'white-01' is swapped with lamp 'white-08'"));
}

TEST(Scan, NamesALampThatIsStuckOn) {
  const TemporaryFolder home;
  const fs::path rig = small_virtual_rig(home);
  replace_in_file(rig, "stuck_on = []", "stuck_on = [\"white-05\"]");
  const Ran ran = run({"scan", "--rig", rig, "-o", home / "scan", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json faults = json::parse(ran.out)["faults"];
  ASSERT_EQ(faults.size(), 1u) << faults;
  EXPECT_EQ(faults[0]["kind"], "stuck-on");
  EXPECT_EQ(faults[0]["lamp"], "white-05");
}

/// Scans with a sensor that vanishes ever later, until one scan has kept something but not all.
Ran scan_cut_off_by_unplugging(const fs::path& rig, const fs::path& stack) {
  std::string now = "unplug_at_frame = -1 ";
  for (int frame = 60; frame < 400; frame += 15) {
    const std::string next = "unplug_at_frame = " + std::to_string(frame) + " ";
    replace_in_file(rig, now, next);
    now = next;
    Ran ran = run({"scan", "--rig", rig, "-o", stack});
    if (ran.exit_code != 4 || fs::exists(stack / "scan.json")) {
      replace_in_file(rig, now, "unplug_at_frame = -1 ");
      return ran;
    }
  }
  return {};
}

TEST(Scan, ThatLosesItsSensorKeepsItsImagesAndIsCompleted) {
  const TemporaryFolder home;
  const fs::path rig = small_virtual_rig(home), stack = home / "scan";
  const Ran ran = scan_cut_off_by_unplugging(rig, stack);
  ASSERT_EQ(ran.exit_code, 4) << ran.err;
  EXPECT_THAT(ran.err,
              AllOf(HasSubstr("the lamps are off"), HasSubstr("images are kept"), HasSubstr("--resume")));
  EXPECT_FALSE(fs::exists(stack / "stack.json"));
  EXPECT_GT(images_so_far(stack), 0u);
  EXPECT_LT(images_so_far(stack), whole_scan());
  EXPECT_EQ(run({"scan", "--rig", rig, "-o", stack}).exit_code, 3) << "it is not thrown away unasked";
  const Ran resumed = run({"scan", "--rig", rig, "-o", stack, "--resume"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  expect_whole(stack);
}

TEST(Scan, ThatIsInterruptedKeepsItsImagesAndIsCompleted) {
  const TemporaryFolder home;
  const fs::path rig = small_virtual_rig(home), stack = home / "scan";
  const std::vector<std::string> scan = {"scan", "--rig", rig, "-o", stack, "--repeats", "10"};
  RunningProgram program(scan);
  for (int i = 0; i < 6000 && images_so_far(stack) < 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.send(SIGINT);
  const Ran ran = program.wait();
  ASSERT_EQ(ran.exit_code, 130) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("the lamps are off"));
  const std::size_t kept = images_so_far(stack);
  EXPECT_GE(kept, 3u);
  const Ran resumed = run({"scan", "--rig", rig, "-o", stack, "--resume"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_GT(color_images(read_stack(stack)), kept);
  EXPECT_EQ(run({"verify", stack}).exit_code, 0);
}

TEST(Scan, NeedsAFolderAndARigThatExist) {
  const TemporaryFolder home;
  const fs::path rig = small_virtual_rig(home);
  EXPECT_EQ(run({"scan", "--rig", rig}).exit_code, 2) << "where to?";
  EXPECT_EQ(run({"scan", "--rig", home / "none.toml", "-o", home / "scan"}).exit_code, 3);
  EXPECT_FALSE(fs::exists(home / "scan"));
}

}  // namespace
}  // namespace rakelight::test
