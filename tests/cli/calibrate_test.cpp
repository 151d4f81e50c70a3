// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "capture/rig_file.h"
#include "stack/image_file.h"
#include "stack/stack_io.h"
#include "tests/capture/rendered_board.h"
#include "tests/support/bump_stack.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A copy of the virtual rig's file.
std::filesystem::path copied_rig(const TemporaryFolder& home) {
  std::filesystem::copy_file(std::filesystem::path(RAKELIGHT_SOURCE_DIR) / "hw/rigs/virtual.toml",
                             home / "rig.toml");
  return home / "rig.toml";
}

TEST(Calibrate, StoresTheColorCameraBesideTheUsersComments) {
  const TemporaryFolder home;
  const std::filesystem::path rig = copied_rig(home);
  const Camera camera{640, 480, 575, 577, 321, 239, {}};
  std::filesystem::create_directories(home / "views/color");
  for (std::size_t k = 0; k < 12; ++k) {
    write_png(home / ("views/color/" + std::to_string(k) + ".png"),
              render_board({}, varied_poses().at(k), camera));
  }
  const Ran ran =
      run({"calibrate", "camera", home / "views", "--rig", rig, "--picture", home / "seen.png", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_LT(nlohmann::json::parse(ran.out)["color_camera"]["reprojection_px"], 0.3);
  const RigCalibration stored = read_rig(rig).calibration;
  ASSERT_TRUE(stored.color_camera);
  EXPECT_NEAR(stored.color_camera->fx, camera.fx, 8);
  EXPECT_FALSE(stored.depth_camera) << "there were no infrared pictures";
  EXPECT_THAT(text_of(rig), HasSubstr("# a lamp lit for longer is switched off by the watchdog"));
  EXPECT_EQ(read_gray_png(home / "seen.png").cols, 4 * 320);
}

TEST(Calibrate, WritesABoardThatItsOwnCameraFinds) {
  const TemporaryFolder home;
  ASSERT_EQ(run({"calibrate", "board", "-o", home / "board.png", "--squares", "9x6"}).exit_code, 0);
  EXPECT_EQ(find_board(read_gray_png(home / "board.png"), {9, 6, 0.03, 0.022}, "board").ids.size(), 8u * 5u);
}

/// A grey card under red, green and blue lamps one by one.
LightStack card() {
  LightStack stack = bump_stack();
  stack.mask = cv::Mat1b();
  stack.frames.resize(4);
  stack.lights = {
      {"r", LampColor::red, {}, {}}, {"g", LampColor::green, {}, {}}, {"b", LampColor::blue, {}, {}}};
  const cv::Scalar seen[]{{0, 0, 0}, {30000, 3000, 0}, {4000, 40000, 2000}, {0, 5000, 25000}};
  for (std::size_t k = 0; k < 4; ++k) {
    stack.frames[k].light.reset();
    if (k > 0) stack.frames[k].light = stack.lights[k - 1].id;
    stack.frames[k].color = cv::Mat(stack.color_camera.size(), CV_16UC3, seen[k]);
  }
  return stack;
}

TEST(Calibrate, StoresTheCrosstalkOfACard) {
  const TemporaryFolder home;
  const std::filesystem::path rig = copied_rig(home);
  write_stack(card(), home / "card");
  const Ran ran = run({"calibrate", "crosstalk", home / "card", "--rig", rig});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("stored in "));
  const auto stored = read_rig(rig).calibration.color_crosstalk;
  ASSERT_TRUE(stored);
  Eigen::Matrix3d expected;
  expected << 1, 0.1, 0, 0.1, 1, 0.2, 0, 0.05, 1;
  EXPECT_LT((*stored - expected).cwiseAbs().maxCoeff(), 1e-3) << *stored;
}

TEST(Calibrate, RefusesToStoreLampsOfAnotherRig) {
  const TemporaryFolder home;
  const std::filesystem::path rig = copied_rig(home);
  const std::string before = text_of(rig);
  write_stack(bump_stack(), home / "scan");
  const Ran ran = run({"calibrate", "lamps", home / "scan", "--rig", rig});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(text_of(rig), before);
}

TEST(Calibrate, MeasuresTheJitterOfTheVirtualLampsAndStoresIt) {
  const TemporaryFolder home;
  const std::filesystem::path rig = copied_rig(home);
  replace_in_file(rig, "lamp_jitter_us = 0 ", "lamp_jitter_us = 4000 ");
  const Ran ran = run({"calibrate", "latency", "--rig", rig, "--toggles", "6", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto found = nlohmann::json::parse(ran.out);
  EXPECT_EQ(found["lamp"], "white-00");
  EXPECT_GT(found["jitter_us"], 300);
  EXPECT_LT(found["jitter_us"], 12000) << "4 ms of the lamp, and what the picture leaves in doubt";
  EXPECT_EQ(read_rig(rig).sensor.lamp_jitter_us, found["lamp_jitter_us"]);
  EXPECT_THAT(text_of(rig), HasSubstr("# of the time from write to light"));
}

TEST(Calibrate, SaysThatALampDoesNotChangeThePicture) {
  const TemporaryFolder home;
  const std::filesystem::path rig = copied_rig(home);
  replace_in_file(rig, "stuck_off = []", "stuck_off = [\"white-03\"]");
  const std::string before = text_of(rig);
  const Ran dead = run({"calibrate", "latency", "--rig", rig, "--lamp", "white-03"});
  EXPECT_EQ(dead.exit_code, 4);
  EXPECT_THAT(dead.err, HasSubstr("lamp 'white-03', but switching it does not change the picture"));
  EXPECT_EQ(text_of(rig), before);
  EXPECT_EQ(run({"calibrate", "latency", "--lamp", "lantern"}).exit_code, 2);
}

TEST(Calibrate, NeedsToBeToldWhat) {
  EXPECT_EQ(run({"calibrate"}).exit_code, 2);
  EXPECT_EQ(run({"calibrate", "camera", "/nowhere"}).exit_code, 3);
  EXPECT_EQ(run({"calibrate", "board", "-o", "b.png", "--squares", "big"}).exit_code, 2);
}

}  // namespace
}  // namespace rakelight::test
