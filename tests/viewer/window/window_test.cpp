// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The real window on a virtual screen, used as a person would. Skipped aloud without Xvfb or xdotool.
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>
#include <memory>

#include "refine/output/result_io.h"
#include "stack/image_file.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/virtual_screen.h"
#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

constexpr int kWidth = 800, kHeight = 600;
const cv::Rect kDrawing(260, 60, 500, 480);  ///< right of the panel, above the status line

class Window : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::VirtualScreen::is_available()) GTEST_SKIP() << "no Xvfb or no xdotool here";
    write_result(test::bump_result(), folder_ / "out");
    screen_ = std::make_unique<test::VirtualScreen>(kWidth, kHeight);
    std::filesystem::current_path(folder_.path());  // where screenshots go
    viewer_ = std::make_unique<test::RunningProgram>(
        std::vector<std::string>{"view", (folder_ / "out").string(), "--size", "800x600", "--light", "150,20",
                                 "--before", "preprocessed"});
    ASSERT_TRUE(screen_->wait_for([](const cv::Mat3b& picture) {
      return cv::mean(picture(kDrawing))[0] > 30;
    })) << "no window came";
    screen_->key("s");  // starts split; go on with one surface
  }
  void TearDown() override { std::filesystem::current_path(std::filesystem::temp_directory_path()); }

  /// The drawing, without the mouse's arrow on it.
  cv::Mat3b look() const {
    screen_->move_to({kWidth - 5, kHeight - 5});
    return screen_->look_when_still()(kDrawing).clone();
  }
  static double difference(const cv::Mat3b& a, const cv::Mat3b& b) {
    return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(3 * a.total());
  }

  test::TemporaryFolder folder_;
  std::unique_ptr<test::VirtualScreen> screen_;
  std::unique_ptr<test::RunningProgram> viewer_;
};

TEST_F(Window, TurnsMovesAndComesBack) {
  const cv::Mat3b front = look();
  screen_->drag({500, 300}, {560, 340});
  const cv::Mat3b turned = look();
  EXPECT_GT(difference(front, turned), 3);
  screen_->key("F2");
  EXPECT_LT(difference(front, look()), 0.5) << "the front view fits as at the start";
  screen_->drag({500, 300}, {560, 300}, 3);
  const cv::Mat3b moved = look();
  EXPECT_LT(difference(moved.colRange(60, 500), front.colRange(0, 440)), 0.5)
      << "moved by the mouse's 60 pixels";
}

TEST_F(Window, LayerKeysAndTheDividerShowBeforeAndAfter) {
  screen_->key("3");
  const cv::Mat3b after = look();
  screen_->key("2");
  const cv::Mat3b before = look();
  EXPECT_GT(difference(before, after), 2);
  screen_->key("3");
  screen_->key("s");
  screen_->drag({400, 500}, {560, 500});
  const cv::Mat3b split = look();
  const int divider = 560 - kDrawing.x;
  EXPECT_LT(difference(split.colRange(0, divider - 4), before.colRange(0, divider - 4)), 0.05);
  EXPECT_LT(difference(split.colRange(divider + 4, 500), after.colRange(divider + 4, 500)), 0.05);
  EXPECT_GT(difference(split, after), 1);
}

TEST_F(Window, ColoursByTheKeys) {
  const cv::Mat3b plain = look();
  screen_->key("c");
  const cv::Mat3b albedo = look();
  EXPECT_GT(difference(plain, albedo), 10);
  screen_->key("v");
  EXPECT_LT(difference(plain, look()), 0.05);
}

TEST_F(Window, MeasuresBetweenTwoClicks) {
  const cv::Mat3b bare = look();
  screen_->key("d");
  screen_->click({400, 300});
  screen_->click({600, 400});
  const cv::Mat3b measured = look();
  const cv::Vec3b on_line = measured(350 - kDrawing.y, 500 - kDrawing.x);
  EXPECT_GT(on_line[0], 230) << "an amber line lies between the points";
  EXPECT_LT(on_line[2], 110);
  screen_->key("Escape");
  EXPECT_LT(difference(bare, look()), 0.05);
}

TEST_F(Window, WritesAPictureOfTheSceneWithoutThePanel) {
  const cv::Mat3b shown = look();
  screen_->key("F12");
  const auto file = folder_ / "rakelight-0001.png";
  ASSERT_TRUE(screen_->wait_for([&](const cv::Mat3b&) { return std::filesystem::exists(file); }));
  look();
  const cv::Mat3b picture = read_color_png(file, cv::Size(kWidth, kHeight));
  EXPECT_LT(difference(picture(kDrawing), shown), 0.5);
  EXPECT_LT(difference(picture(cv::Rect(780, 0, 20, 600)), picture(cv::Rect(0, 0, 20, 600))), 30)
      << "no panel";
}

TEST(WindowOnAFineScreen, IsTwiceAsLarge) {
  if (!test::VirtualScreen::is_available() || std::system("command -v xprop >/dev/null") != 0)
    GTEST_SKIP() << "no Xvfb, xdotool or xprop here";
  const test::TemporaryFolder folder;
  write_result(test::bump_result(), folder / "out");
  const test::VirtualScreen screen(2 * kWidth, 2 * kHeight, 192);
  test::RunningProgram viewer({"view", (folder / "out").string(), "--size", "800x600"});
  const cv::Vec3b background(27, 28, 32);
  EXPECT_TRUE(screen.wait_for([&](const cv::Mat3b& picture) {
    return cv::norm(picture(2 * kHeight - 5, 2 * kWidth - 5), background) < 12;
  })) << "the window fills the screen";
  const cv::Rect closing_cross(2 * 215, 2 * 8, 2 * 25, 2 * 16);  // right in the panel's title
  double brightest = 0;
  cv::minMaxLoc(screen.look_when_still()(closing_cross).reshape(1), nullptr, &brightest);
  EXPECT_GT(brightest, 150) << "the panel has grown with the letters";
  screen.key("q");
  EXPECT_EQ(viewer.wait().exit_code, 0);
}

TEST_F(Window, QuitsByItsKey) {
  screen_->key("q");
  EXPECT_EQ(viewer_->wait().exit_code, 0);
}

}  // namespace
}  // namespace rakelight
