// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "stack/atomic_folder.h"
#include "stack/float_tiff.h"
#include "stack/image_file.h"
#include "stack/stack_io.h"
#include "tests/support/bump_stack.h"
#include "tests/support/file_edits.h"
#include "tests/support/run_program.h"
#include "tests/support/tiny_disk.h"

namespace rakelight::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// A folder with the stack `scan` in it.
class Refine : public testing::Test {
 protected:
  void SetUp() override { write_stack(bump_stack(), scan(), bump_truth()); }

  fs::path scan() const { return folder_ / "scan"; }
  fs::path out() const { return folder_ / "out"; }
  Ran refine(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"refine", scan(), "-o", out()});
    return run(more);
  }
  /// Exit code as expected, one line that holds `text`, and no result.
  void expect_refused(const Ran& ran, int exit_code, const std::string& text) const {
    EXPECT_EQ(ran.exit_code, exit_code) << ran.err;
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr(text));
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(fs::exists(out()));
  }
  nlohmann::json manifest() const { return nlohmann::json::parse(text_of(out() / "result.json")); }

  TemporaryFolder folder_;
};

TEST_F(Refine, WritesOnlyTheOutputsAskedFor) {
  const Ran ran = refine({"--outputs", "depth,normals"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, Not(HasSubstr("mesh.ply")));
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(out())) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"depth.tiff", "depth.png", "initial_depth.tiff", "normals.tiff",
                                          "normals.png", "result.json"}));
}

TEST_F(Refine, RefusesAnOutputItDoesNotKnow) {
  expect_refused(refine({"--outputs", "depth,sculpture"}), 2, "sculpture");
}

TEST_F(Refine, WritesAResultAndSaysWhere) {
  const Ran ran = refine();
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr((out() / "mesh.ply").string()));
  EXPECT_EQ(manifest().at("scale"), 2);  // as fine as the colour images
  EXPECT_EQ(read_float_tiff(out() / "depth.tiff").size(), cv::Size(96, 72));
}

TEST_F(Refine, DrawsNoBarWhereThereIsNoTerminal) { EXPECT_THAT(refine().err, Not(HasSubstr("["))); }

TEST_F(Refine, PrintsOneJsonObjectAndNothingElse) {
  const Ran ran = refine({"--json", "--scale", "1"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << ran.out;
  EXPECT_EQ(json.at("folder"), out().string());
  EXPECT_EQ(json.at("scale"), 1);
}

TEST_F(Refine, NamesAReportThatShowsEveryFrame) {
  const Ran ran = refine();
  EXPECT_THAT(ran.out, HasSubstr((out() / "report.html").string()));
  const std::string page = text_of(out() / "report.html");
  for (const Frame& frame : bump_stack().frames)
    EXPECT_THAT(page, HasSubstr("{\"index\":" + std::to_string(frame.index) + ","));
}

TEST_F(Refine, IsEvaluatedWithFiguresOfTheErrors) {
  ASSERT_EQ(refine().exit_code, 0);
  const Ran ran = run({"evaluate", out(), "--truth", scan(), "--plots", folder_ / "figures"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  for (const char* name :
       {"depth_error.png", "normal_error.png", "depth_histogram.png", "normal_histogram.png"})
    EXPECT_TRUE(fs::exists(folder_ / "figures" / name)) << name;
}

TEST_F(Refine, BringsTheSurfaceNearerToTheTruth) {
  ASSERT_EQ(refine().exit_code, 0);
  const Ran ran = run({"evaluate", out(), "--truth", scan(), "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  EXPECT_LT(json.at("rmse_mm"), json.at("before").at("rmse_mm"));
  EXPECT_LT(json.at("mae_deg").get<double>(), 0.5 * json.at("before").at("mae_deg").get<double>());
  EXPECT_EQ(json.at("complete"), 1.0);
}

TEST_F(Refine, TakesParametersFromTheFileAndTheCommandLineOverThem) {
  set_text(folder_ / "tuned.toml",
           "preset = \"paper\"\nscale = 2\nmax_iterations = 3\n"
           "[preprocess]\nbilateral_sigma_px = 2.5\n");
  const Ran ran = refine({"--config", folder_ / "tuned.toml", "--scale", "1"});
  ASSERT_TRUE(fs::exists(out() / "result.json")) << ran.err;
  const auto options = manifest().at("options");
  EXPECT_EQ(options.at("preset"), "paper");
  EXPECT_EQ(options.at("scale"), 1);
  EXPECT_EQ(options.at("max_iterations"), 3);
  EXPECT_EQ(options.at("preprocess").at("bilateral_sigma_px"), 2.5);
}

TEST_F(Refine, TakesTheSolverAndTheLightModelFromTheCommandLine) {
  const Ran ran = refine({"--solver", "exact", "--lamps", "far", "--lamp-positions", "start", "--harmonics",
                          "2", "--iterations", "3", "--scale", "1"});
  ASSERT_TRUE(fs::exists(out() / "result.json")) << ran.err;
  const auto options = manifest().at("options");
  EXPECT_EQ(options.at("depth").at("solver"), "exact");
  EXPECT_EQ(options.at("lamps").at("model"), "far");
  EXPECT_EQ(options.at("lamps").at("positions"), "start");
  EXPECT_EQ(options.at("lamps").at("harmonics"), 2);
  EXPECT_EQ(manifest().at("lights").at(0).at("second_order_rgb").size(), 3u);
}

TEST_F(Refine, NamesKeyAndLineOfWhatIsWrongInTheFile) {
  const auto refused = [&](const std::string& text, const std::string& message) {
    set_text(folder_ / "bad.toml", text);
    expect_refused(refine({"--config", folder_ / "bad.toml"}), 3, message);
  };
  refused("scale = 1\nsharpness = 9\n", "bad.toml line 2: 'sharpness'");
  refused("[preprocess]\nsigma = 1\n", "bad.toml line 2: 'preprocess.sigma'");
  refused("preprocess = 1\n", "bad.toml line 1: 'preprocess'");
  refused("scale = \"two\"\n", "bad.toml line 1: 'scale'");
  refused("[preprocess]\n\nbilateral_sigma_px = nan\n", "bad.toml line 3");
  refused("[preprocess]\nbilateral_sigma_px = -1\n", "bad.toml line 2");
  refused("preset = \"wild\"\n", "paper, robust");
  refused("scale = \n", "bad.toml line 1");
  expect_refused(refine({"--config", folder_ / "absent.toml"}), 3, "absent.toml");
}

TEST_F(Refine, RefusesAScaleFinerThanTheColour) { expect_refused(refine({"--scale", "3"}), 2, "colour"); }

TEST_F(Refine, RefusesOptionsOutOfRange) {
  expect_refused(refine({"--scale", "9"}), 2, "--scale");
  expect_refused(refine({"--preset", "wild"}), 2, "--preset");
  expect_refused(refine({"--response", "wild"}), 2, "wild");
  expect_refused(refine({"--iterations", "0"}), 2, "--iterations");
  expect_refused(refine({"--harmonics", "3"}), 2, "--harmonics");
  expect_refused(refine({"--harmonics", "2", "--lamps", "near"}), 2, "--harmonics");
}

TEST_F(Refine, RefusesAStackThatIsNotThere) {
  expect_refused(run({"refine", folder_ / "absent", "-o", out()}), 3, "absent");
}

TEST_F(Refine, LooksForTheColourResponseAndSaysWhatItFound) {
  const Ran ran = refine({"--response", "auto", "--scale", "1"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("response: "));
  const auto result = manifest();
  EXPECT_EQ(result.at("options").at("estimate_response"), true);
  EXPECT_EQ(result.at("color_response"), "linear");  // found to agree, or not sure and kept
  const auto& estimate = result.at("response_estimate");
  EXPECT_EQ(estimate.at("message").get<std::string>().rfind("response: ", 0), 0U);
  EXPECT_TRUE(estimate.contains("gamma") && estimate.contains("deviation") && estimate.contains("sure"));
}

TEST_F(Refine, TakesAnotherMask) {
  cv::Mat1b mask(bump_stack().mask.size(), uchar{0});
  mask(cv::Rect(24, 18, 40, 30)).setTo(255);
  write_png(folder_ / "mask.png", mask);
  ASSERT_EQ(refine({"--mask", folder_ / "mask.png"}).exit_code, 0);
  const cv::Mat1f depth = read_float_tiff(out() / "depth.tiff");
  EXPECT_TRUE(std::isnan(depth(10, 10)));
  EXPECT_GT(depth(30, 40), 0.5f);
}

TEST_F(Refine, TakesEveryPixelWithDepthByMaskAuto) {
  ASSERT_EQ(refine({"--mask", "auto", "--scale", "1"}).exit_code, 0);
  EXPECT_GT(read_float_tiff(out() / "depth.tiff")(1, 1), 0.5f);  // outside the stack's own mask
}

TEST_F(Refine, LeavesAFolderAloneThatIsNoResult) {
  fs::create_directory(out());
  set_text(out() / "letter.txt", "dear");
  const Ran ran = refine();
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(text_of(out() / "letter.txt"), "dear");
}

TEST_F(Refine, SaysThatAnotherProgramIsWriting) {
  const AtomicFolder other(out(), {"result", "result.json", {}});
  expect_refused(refine(), 5, "out");
}

TEST_F(Refine, SaysThatTheDiskIsFullAndKeepsTheEarlierResult) {
  const TinyDisk disk(1500);
  if (!disk.mounted()) GTEST_SKIP() << "needs root to mount a small tmpfs";
  const fs::path target = disk.path() / "out";
  ASSERT_EQ(run({"refine", scan(), "-o", target}).exit_code, 0);
  const std::string before = text_of(target / "result.json");
  std::ofstream filler(disk.path() / "filler", std::ios::binary);
  while (filler.put('x').flush()) {}
  const Ran ran = run({"refine", scan(), "-o", target});
  EXPECT_EQ(ran.exit_code, 6) << ran.err;
  EXPECT_EQ(text_of(target / "result.json"), before);
  EXPECT_EQ(std::distance(fs::directory_iterator(disk.path()), {}), 2);
}

TEST_F(Refine, StopsOnAnInterruptAndWritesNothing) {
  // A run that may settle could end before the signal comes.
  set_text(folder_ / "endless.toml", "min_iterations = 100000\nmax_iterations = 100000\n");
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningProgram program({"refine", scan(), "-o", out(), "--config", folder_ / "endless.toml"});
    std::this_thread::sleep_for(std::chrono::milliseconds(700));
    program.send(signal);
    const Ran ran = program.wait();
    EXPECT_EQ(ran.exit_code, 130) << ran.err;
    EXPECT_FALSE(fs::exists(out()));
  }
}

}  // namespace
}  // namespace rakelight::test
