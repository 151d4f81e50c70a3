// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `scan --view` with the virtual rig on a virtual screen. Skipped aloud without Xvfb or xdotool.
#include <gmock/gmock.h>

#include <cstdlib>
#include <memory>

#include "tests/cli/small_virtual_rig.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"

namespace rakelight::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const cv::Size kScreen(1280, 640);
const cv::Rect kColor(160, 130, 320, 380);  ///< inside the colour picture, on the left
const cv::Vec3b kBackground(27, 28, 32);    ///< behind a surface; pictures stand on black

class ScanView : public testing::Test {
 protected:
  void SetUp() override {
    if (!VirtualScreen::is_available()) GTEST_SKIP() << "no Xvfb or no xdotool here";
    screen_ = std::make_unique<VirtualScreen>(kScreen.width, kScreen.height);
  }
  bool sees(const std::function<bool(const cv::Scalar&)>& wanted) const {
    return screen_->wait_for([&](const cv::Mat3b& picture) { return wanted(cv::mean(picture(kColor))); });
  }
  bool sees_a_surface() const {
    return screen_->wait_for([](const cv::Mat3b& picture) {
      return cv::norm(picture(620, 1270), kBackground) < 12 && picture(320, 640)[1] > 60;
    });
  }
  TemporaryFolder home_;
  std::unique_ptr<VirtualScreen> screen_;
};

TEST_F(ScanView, ShowsEachLampAndThenTheScan) {
  RunningProgram program(
      {"scan", "--rig", small_virtual_rig(home_), "-o", home_ / "scan", "--repeats", "8", "--view"});
  EXPECT_TRUE(sees([](const cv::Scalar& c) { return c[0] > 10 && c[0] < 1.5 * c[2]; })) << "a white lamp";
  EXPECT_TRUE(sees([](const cv::Scalar& c) { return c[0] > 6 && c[0] > 3 * c[2]; })) << "the red lamp";
  EXPECT_TRUE(sees([](const cv::Scalar& c) { return c[2] > 6 && c[2] > 3 * c[0]; })) << "the blue lamp";
  EXPECT_TRUE(sees_a_surface());
  screen_->key("q");
  const Ran ran = program.wait();
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST_F(ScanView, ShowsTheSurfaceBeforeItIsFinished) {
  RunningProgram program({"scan", "--rig", small_virtual_rig(home_), "-o", home_ / "scan", "--mask", "auto",
                          "--refine", home_ / "out", "--view"});
  EXPECT_TRUE(sees_a_surface());
  EXPECT_FALSE(fs::exists(home_ / "out/result.json"));
  screen_->key("q");
  const Ran ran = program.wait();
  EXPECT_EQ(ran.exit_code, 130) << ran.err;
  EXPECT_TRUE(fs::exists(home_ / "scan/stack.json")) << "the scan was whole";
}

TEST_F(ScanView, ThatIsClosedEndsAsByCtrlC) {
  RunningProgram program(
      {"scan", "--rig", small_virtual_rig(home_), "-o", home_ / "scan", "--repeats", "40", "--view"});
  ASSERT_TRUE(screen_->wait_for([&](const cv::Mat3b&) { return fs::exists(home_ / "scan/scan.json"); }));
  screen_->key("q");
  const Ran ran = program.wait();
  EXPECT_EQ(ran.exit_code, 130) << ran.err;
  EXPECT_THAT(ran.err, AllOf(HasSubstr("the lamps are off"), HasSubstr("--resume")));
}

TEST_F(ScanView, ThatLosesItsDisplayKeepsItsImages) {
  RunningProgram program(
      {"scan", "--rig", small_virtual_rig(home_), "-o", home_ / "scan", "--repeats", "10", "--view"});
  ASSERT_TRUE(screen_->wait_for([&](const cv::Mat3b&) { return fs::exists(home_ / "scan/scan.json"); }));
  screen_->end();
  const Ran ran = program.wait();
  EXPECT_EQ(ran.exit_code, 4) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("its display went away"));
  EXPECT_EQ(run({"scan", "--rig", home_ / "rig.toml", "-o", home_ / "scan", "--resume"}).exit_code, 0);
}

TEST(ScanViewWithoutADisplay, DoesNotBegin) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const TemporaryFolder home;
  const Ran ran = run({"scan", "--rig", small_virtual_rig(home), "-o", home / "scan", "--view"});
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.err, HasSubstr("no display for a window"));
  EXPECT_FALSE(fs::exists(home / "scan"));
}

}  // namespace
}  // namespace rakelight::test
