// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/mouse.h"

#include <gtest/gtest.h>

#include <vector>

namespace rakelight {
namespace {

const cv::Size2d kWindow(800, 600);

class Mouse : public testing::Test {
 protected:
  std::vector<cv::Point2d> clicks_;
  MouseControl mouse_{[this](const cv::Point2d& at) { clicks_.push_back(at); }};
  ViewState state_;
  void drag(MouseButton button, const cv::Point2d& from, const cv::Point2d& to, bool shift = false) {
    mouse_.press(state_, button, shift, from, kWindow);
    mouse_.move(state_, to, kWindow);
    mouse_.release(to);
  }
};

TEST_F(Mouse, LeftTurnsRightMoves) {
  drag(MouseButton::left, {400, 300}, {460, 300});
  EXPECT_NE(state_.camera.azimuth, 0);
  EXPECT_EQ(state_.camera.target.norm(), 0);
  const double azimuth = state_.camera.azimuth;
  drag(MouseButton::right, {400, 300}, {460, 300});
  drag(MouseButton::left, {400, 300}, {460, 300}, true);
  EXPECT_EQ(state_.camera.azimuth, azimuth);
  EXPECT_GT(state_.camera.target.norm(), 0);
}

TEST_F(Mouse, APressThatHardlyMovesIsAClick) {
  drag(MouseButton::left, {400, 300}, {402, 301});
  EXPECT_EQ(clicks_.size(), 1u);
  EXPECT_EQ(state_.camera.azimuth, 0);
  drag(MouseButton::left, {400, 300}, {430, 301});
  drag(MouseButton::right, {400, 300}, {400, 300});
  EXPECT_EQ(clicks_.size(), 1u);
}

TEST_F(Mouse, TheDividerIsDraggedOnlyWhereItIs) {
  state_.look.split = true;
  drag(MouseButton::left, {402, 100}, {200, 120});
  EXPECT_DOUBLE_EQ(state_.look.divider, 0.25);
  EXPECT_EQ(state_.camera.azimuth, 0);
  drag(MouseButton::left, {402, 100}, {500, 100});
  EXPECT_DOUBLE_EQ(state_.look.divider, 0.25);
  drag(MouseButton::left, {200, 100}, {-50, 100});
  EXPECT_DOUBLE_EQ(state_.look.divider, 0);
}

TEST_F(Mouse, TheLightFollowsUntilItIsHeld) {
  mouse_.move(state_, {790, 300}, kWindow);
  EXPECT_NEAR(state_.look.light.azimuth_deg, 0, 1e-9);
  EXPECT_LT(state_.look.light.elevation_deg, 10);
  state_.light_follows_mouse = false;
  mouse_.move(state_, {400, 10}, kWindow);
  EXPECT_NEAR(state_.look.light.azimuth_deg, 0, 1e-9);
}

TEST_F(Mouse, TheWheelZooms) {
  mouse_.scroll(state_, 1, {400, 300}, kWindow);
  EXPECT_LT(state_.camera.distance, 1);
}

}  // namespace
}  // namespace rakelight
