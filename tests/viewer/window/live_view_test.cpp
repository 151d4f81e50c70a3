// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work that is watched, on a virtual screen. Skipped aloud without Xvfb or xdotool.
#include "viewer/live_view.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "tests/support/virtual_screen.h"
#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

const cv::Size kSize(640, 480);

class LiveView : public testing::Test {
 protected:
  void SetUp() override {
    if (!test::VirtualScreen::is_available()) GTEST_SKIP() << "no Xvfb or no xdotool here";
    screen_ = std::make_unique<test::VirtualScreen>(kSize.width, kSize.height);
  }
  bool sees(const cv::Point& at, const cv::Vec3b& color) const {
    return screen_->wait_for([&](const cv::Mat3b& picture) { return cv::norm(picture(at), color) < 12; });
  }
  std::unique_ptr<test::VirtualScreen> screen_;
};

TEST_F(LiveView, ShowsColourAndDepthAndThenTheSurfaceAsItChanges) {
  const RefineResult result = test::bump_result();
  const auto work = [&](LiveFeed& feed) {
    feed.show_color(cv::Mat3b(48, 64, cv::Vec3b(200, 30, 30)));
    feed.show_depth(cv::Mat1w(48, 64, static_cast<ushort>(0)), 0.001);
    EXPECT_TRUE(sees({160, 240}, {200, 30, 30}));
    feed.show_color(cv::Mat3b(48, 64, cv::Vec3b(30, 30, 200)));
    EXPECT_TRUE(sees({160, 240}, {30, 30, 200}));
    feed.show_surface(result.camera, result.initial_depth);
    EXPECT_TRUE(screen_->wait_for([](const cv::Mat3b& picture) { return picture(240, 400)[1] > 60; }));
    const cv::Mat3b flat = screen_->look_when_still();
    feed.show_surface(result.camera, result.depth);
    EXPECT_TRUE(
        screen_->wait_for([&](const cv::Mat3b& now) { return cv::norm(now, flat, cv::NORM_INF) > 25; }));
  };
  show_live("live", kSize, work, [] { return false; });
}

TEST_F(LiveView, ClosingTheWindowLeavesTheWorkToItsEnd) {
  bool finished = false;
  show_live("live", kSize, [&](LiveFeed& feed) {
    feed.show_surface(test::bump_result().camera, test::bump_result().depth);
    EXPECT_TRUE(screen_->wait_for([](const cv::Mat3b& picture) { return picture(240, 400)[1] > 60; }));
    screen_->key("q");
    while (feed.is_watched()) screen_->look_when_still();
    finished = true;
  });
  EXPECT_TRUE(finished);
}

TEST_F(LiveView, StaysOpenAfterTheWorkAsLongAsItIsToldTo) {
  int asked = 0;
  const RefineResult result = test::bump_result();
  show_live(
      "live", kSize, [&](LiveFeed& feed) { feed.show_surface(result.camera, result.depth); },
      [&] { return ++asked < 20; });
  EXPECT_EQ(asked, 20);
}

TEST_F(LiveView, WaitsForTheWorkWhenTheDisplayGoesAway) {
  bool lamps_off = false;
  const auto work = [&](LiveFeed& feed) {
    screen_->end();
    while (feed.is_watched()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    lamps_off = true;
  };
  EXPECT_THROW(show_live("live", kSize, work), std::system_error);
  EXPECT_TRUE(lamps_off);
}

TEST_F(LiveView, PassesOnWhatTheWorkThrows) {
  EXPECT_THROW(show_live("live", kSize, [](LiveFeed&) { throw std::runtime_error("sensor lost"); }),
               std::runtime_error);
}

TEST(LiveViewWithoutADisplay, DoesNotBeginTheWork) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  EXPECT_THROW(show_live("live", kSize, [](LiveFeed&) { FAIL() << "began"; }), std::system_error);
}

}  // namespace
}  // namespace rakelight
