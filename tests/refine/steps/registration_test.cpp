// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/registration.h"

#include <gtest/gtest.h>

#include "tests/refine/depth_frames.h"

namespace rakelight {
namespace {

/// A frame with one reading.
Frame single_reading(const LightStack& stack, int u, int v, double depth_m) {
  return test::depth_frame(stack, [&](int x, int y) { return x == u && y == v ? depth_m : 0.0; });
}

/// The pixels that have depth.
std::vector<cv::Point> readings(const cv::Mat1f& depth) {
  std::vector<cv::Point> found;
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      if (!std::isnan(depth(v, u))) found.emplace_back(u, v);
  return found;
}

TEST(RegisteredDepth, OfTheSameViewIsPassedOn) {
  const LightStack stack = test::empty_stack();
  const Frame frame =
      test::depth_frame(stack, [](int u, int v) { return u == 3 ? 0.0 : 1 + 0.001 * u + 0.002 * v; });
  const cv::Mat1f depth = registered_depth(stack, frame);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      EXPECT_EQ(std::isnan(depth(v, u)), u == 3);
      if (u == 3) continue;
      EXPECT_FLOAT_EQ(depth(v, u), static_cast<float>(frame.depth(v, u) * 0.0001));
    }
  }
}

TEST(RegisteredDepth, OfACameraBesideLandsWhereGeometrySays) {
  LightStack stack = test::empty_stack();
  stack.T_color_depth(0, 3) = 0.05;   // 5 px at 1 m
  stack.T_color_depth(1, 3) = -0.02;  // 2 px
  const cv::Mat1f depth = registered_depth(stack, test::depth_frame(stack, [](int, int) { return 1.0; }));
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const bool seen = u >= 5 && v < 58;
      EXPECT_EQ(!std::isnan(depth(v, u)), seen) << u << ", " << v;
      if (!seen) continue;
      EXPECT_FLOAT_EQ(depth(v, u), 1.0f);
    }
  }
}

TEST(RegisteredDepth, OfACameraBehindIsFarther) {
  LightStack stack = test::empty_stack();
  stack.T_color_depth(2, 3) = 0.25;
  const cv::Mat1f depth = registered_depth(stack, single_reading(stack, 59, 29, 1.0));
  ASSERT_EQ(readings(depth).size(), 1U);  // 19.5 px right of the axis at 1 m: 15.6 px at 1.25 m
  EXPECT_EQ(readings(depth).front(), cv::Point(55, 29));
  EXPECT_FLOAT_EQ(depth(29, 55), 1.25f);
}

TEST(RegisteredDepth, OfATurnedCameraIsTurned) {
  LightStack stack = test::empty_stack();  // a quarter turn about the optical axis: x -> y, y -> -x
  stack.T_color_depth.topLeftCorner<2, 2>() << 0, -1, 1, 0;
  const cv::Mat1f depth = registered_depth(stack, single_reading(stack, 49, 24, 0.8));
  ASSERT_EQ(readings(depth).size(), 1U);  // (9.5, -5.5) px from the axis turns to (5.5, 9.5)
  EXPECT_EQ(readings(depth).front(), cv::Point(45, 39));
}

TEST(RegisteredDepth, WhereTwoReadingsMeetTheNearerOneStays) {
  LightStack stack = test::empty_stack();
  stack.T_color_depth(0, 3) = 0.1;  // 10 px at 1 m, 20 px at 0.5 m
  const Frame frame = test::depth_frame(stack, [](int u, int v) {
    if (v != 20) return 0.0;
    return u == 40 ? 1.0 : u == 30 ? 0.5 : 0.0;
  });
  const cv::Mat1f depth = registered_depth(stack, frame);
  ASSERT_EQ(readings(depth).size(), 1U);
  EXPECT_FLOAT_EQ(depth(20, 50), 0.5f);
}

TEST(RegisteredDepth, LensDistortionIsTakenOut) {
  LightStack stack = test::empty_stack();
  stack.depth_camera.distortion = {0.5, 0, 0, 0, 0};
  const double ray = 0.25, seen = ray * (1 + 0.5 * ray * ray);  // k1 bends the ray outwards
  const int u = static_cast<int>(std::lround(39.5 + 100 * seen));
  const cv::Mat1f depth = registered_depth(stack, single_reading(stack, u, 29, 1.0));
  ASSERT_EQ(readings(depth).size(), 1U);
  EXPECT_NEAR(readings(depth).front().x, 39.5 + 100 * ray, 1.0);
  EXPECT_LT(readings(depth).front().x, u);
}

TEST(RegisteredDepthCamera, IsTheColourCameraBinnedToTheDepthsResolution) {
  LightStack stack = test::empty_stack();
  stack.color_camera = {160, 120, 200.0, 200.0, 80.5, 60.5, {0.1, 0, 0, 0, 0}};
  EXPECT_EQ(color_to_depth_ratio(stack), 2);
  const Camera camera = registered_depth_camera(stack);
  EXPECT_EQ(camera.size(), cv::Size(80, 60));
  EXPECT_DOUBLE_EQ(camera.fx, 100);
  EXPECT_DOUBLE_EQ(camera.cx, 40);
  EXPECT_TRUE(camera.distortion.empty());
}

TEST(ColorToDepthRatio, StaysWithinOneToFour) {
  LightStack stack = test::empty_stack();
  stack.color_camera.fx = 30;
  EXPECT_EQ(color_to_depth_ratio(stack), 1);
  stack.color_camera.fx = 900;
  EXPECT_EQ(color_to_depth_ratio(stack), 4);
}

}  // namespace
}  // namespace rakelight
