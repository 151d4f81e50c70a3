// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/auto_mask.h"

#include <gtest/gtest.h>

namespace rakelight {
namespace {

const cv::Rect kObject(50, 30, 60, 60);

/// A box at 0.8 m before a wall at 1.2 m, 160 x 120, a dark frame and one lit one; depth in millimetres.
LightStack box_before_wall() {
  LightStack stack;
  stack.color_camera = stack.depth_camera = {160, 120, 142, 142, 79.5, 59.5, {}};
  stack.depth_unit_m = 0.001;
  stack.lights = {{"lamp", LampColor::white, {}, {}}};
  for (int k = 0; k < 2; ++k) {
    Frame frame;
    frame.index = k;
    frame.color = cv::Mat(120, 160, CV_8UC3, cv::Scalar::all(k == 0 ? 10 : 160));
    frame.depth = cv::Mat1w(120, 160, std::uint16_t{1200});
    frame.depth(kObject).setTo(800);
    if (k == 1) frame.light = "lamp";
    stack.frames.push_back(frame);
  }
  return stack;
}

double outside_share(const cv::Mat1b& mask, const cv::Rect& inside) {
  cv::Mat1b outside = mask.clone();
  outside(inside).setTo(0);
  return 1.0 * cv::countNonZero(outside) / inside.area();
}

TEST(AutoMask, IsThePieceThatFillsTheMiddle) {
  const cv::Mat1b mask = auto_mask(box_before_wall());
  ASSERT_EQ(mask.size(), cv::Size(160, 120));
  EXPECT_GT(cv::countNonZero(mask(kObject)), 0.97 * kObject.area());
  EXPECT_LT(outside_share(mask, kObject), 0.01);
}

TEST(AutoMask, LeavesOutWhatNoLampLights) {
  LightStack stack = box_before_wall();
  const cv::Rect dark(50, 30, 60, 20);
  stack.frames[1].color(dark).setTo(cv::Scalar::all(11));
  const cv::Mat1b mask = auto_mask(stack);
  EXPECT_LT(cv::countNonZero(mask(dark)), 0.1 * dark.area());
  EXPECT_GT(cv::countNonZero(mask), 0.9 * (kObject.area() - dark.area()));
}

TEST(AutoMask, FillsReadingsThatAreMissingButKeepsAHoleOfTheObject) {
  LightStack stack = box_before_wall();
  const cv::Rect missing(60, 40, 2, 2), hole(80, 50, 16, 16);
  for (Frame& frame : stack.frames) {
    frame.depth(missing).setTo(0);
    frame.depth(hole).setTo(1200);
  }
  const cv::Mat1b mask = auto_mask(stack);
  EXPECT_EQ(cv::countNonZero(mask(missing)), missing.area());
  EXPECT_LT(cv::countNonZero(mask(hole)), 0.2 * hole.area());
}

TEST(AutoMask, IsOnTheDepthGridWhereTheDepthCameraStandsBesideTheOther) {
  LightStack stack = box_before_wall();
  stack.T_color_depth(0, 3) = 0.05;         // 9 pixels at 0.8 m
  const cv::Rect dark(50 + 9, 30, 20, 60);  // of the colour image: columns 50 to 70 of the depth image
  stack.frames[1].color(dark).setTo(cv::Scalar::all(11));
  const cv::Mat1b mask = auto_mask(stack);
  EXPECT_LT(cv::countNonZero(mask(cv::Rect(51, 34, 17, 50))), 100);
  EXPECT_GT(cv::countNonZero(mask(cv::Rect(72, 34, 36, 50))), 0.95 * 36 * 50);
}

TEST(AutoMask, IsEmptyWhereNothingIsLit) {
  LightStack stack = box_before_wall();
  for (Frame& frame : stack.frames) frame.depth.setTo(0);
  EXPECT_TRUE(auto_mask(stack).empty());
}

}  // namespace
}  // namespace rakelight
