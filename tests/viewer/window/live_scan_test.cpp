// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scan that is watched: what the person does with the window, lamps hear of. Skipped aloud without Xvfb or xdotool.
#include <gtest/gtest.h>

#include "capture/capture.h"
#include "stack/errors.h"
#include "tests/capture/simulated_rig.h"
#include "tests/support/virtual_screen.h"
#include "viewer/live_view.h"

namespace rakelight {
namespace {

TEST(LiveScan, TurnsAllLampsOffWhenItsWindowIsClosed) {
  if (!test::VirtualScreen::is_available()) GTEST_SKIP() << "no Xvfb or no xdotool here";
  const test::VirtualScreen screen(320, 240);
  const test::SimulatedRigOptions rig_options;
  const Rig rig = test::simulated_rig(rig_options);
  test::SimulatedRig devices(rig, rig_options);
  bool closed = false, lit_when_closed = false;
  const auto scan = [&](LiveFeed& feed) {
    const auto close_under_a_lamp = [&](const ScanProgress&) {
      if (!closed && !devices.lit_now().empty()) {
        lit_when_closed = closed = true;
        screen.wait_for([](const cv::Mat3b& picture) { return cv::norm(picture, cv::NORM_INF) > 0; });
        screen.key("q");
        while (feed.is_watched()) screen.look_when_still();
      }
      return feed.is_watched();
    };
    feed.show_color(cv::Mat3b(24, 32, cv::Vec3b(90, 90, 90)));
    capture_stack({devices.source(), devices.lights(), devices.clock}, rig, {}, close_under_a_lamp);
  };
  EXPECT_THROW(show_live("scan", {320, 240}, scan), Cancelled);
  EXPECT_TRUE(lit_when_closed);
  EXPECT_TRUE(devices.lit_now().empty());
}

}  // namespace
}  // namespace rakelight
