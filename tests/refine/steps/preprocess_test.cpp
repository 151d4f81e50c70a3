// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/preprocess.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "stack/errors.h"
#include "tests/refine/depth_frames.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

const float kNaN = std::numeric_limits<float>::quiet_NaN();

double ramp(int u, int v) { return 1.0 + 0.002 * u - 0.001 * v; }

cv::Mat1f ramp_image() {
  cv::Mat1f depth(60, 80);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u) depth(v, u) = static_cast<float>(ramp(u, v));
  return depth;
}

TEST(InpaintDepth, FillsAHoleInARamp) {
  cv::Mat1f depth = ramp_image();
  const cv::Rect hole(30, 20, 8, 8);
  depth(hole).setTo(kNaN);
  cv::Mat1b holes(depth.size(), uchar{0});
  holes(hole).setTo(255);
  const cv::Mat1f filled = inpaint_depth(depth, holes);
  double inside = 0, outside = 0;
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      double& worst = hole.contains({u, v}) ? inside : outside;
      worst = std::max(worst, std::abs(static_cast<double>(filled(v, u)) - ramp(u, v)));
    }
  }
  EXPECT_LT(inside, 0.008);  // metres; the nearest reading's value would be 0.012 off
  EXPECT_LT(outside, 1e-6);
}

TEST(InpaintDepth, LeavesNoPixelWithoutAValue) {
  cv::Mat1f depth(40, 50, kNaN);
  depth(cv::Rect(10, 10, 5, 5)).setTo(0.7f);
  EXPECT_TRUE(cv::checkRange(inpaint_depth(depth, cv::Mat1b(depth.size(), uchar{0}))));
}

TEST(MergeDepthFrames, AveragesWhatAgreesAndDropsWhatDoesNot) {
  std::vector<cv::Mat1f> frames;
  for (const float z : {1.000f, 1.002f, 0.998f, 1.001f, 0.999f, 2.5f}) frames.emplace_back(2, 2, z);
  EXPECT_NEAR(static_cast<double>(merge_depth_frames(frames)(0, 0)), 1.0, 0.001);
}

TEST(MergeDepthFrames, GrowMorePreciseWithTheirNumber) {
  std::mt19937 random(1);
  std::normal_distribution<float> noise(1, 0.004f);
  std::vector<cv::Mat1f> frames(16);
  for (cv::Mat1f& frame : frames) {
    frame = cv::Mat1f(40, 40);
    for (float& z : frame) z = noise(random);
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(merge_depth_frames(frames), mean, deviation);
  EXPECT_NEAR(mean[0], 1, 0.0002);
  EXPECT_LT(deviation[0], 1.2 * 0.004 / 4);
}

TEST(MergeDepthFrames, AReadingInTooFewFramesIsNone) {
  std::vector<cv::Mat1f> frames(6);
  for (cv::Mat1f& frame : frames) frame = cv::Mat1f(1, 2, kNaN);
  frames[0](0, 0) = 1;
  frames[1](0, 1) = frames[2](0, 1) = 1;
  const cv::Mat1f merged = merge_depth_frames(frames);
  EXPECT_TRUE(std::isnan(merged(0, 0)));
  EXPECT_EQ(merged(0, 1), 1);
}

TEST(MeasureDepthNoise, FindsWhiteNoiseOnARampWithinAFifth) {
  for (const float deviation : {0.0005f, 0.003f}) {
    cv::Mat1f depth = ramp_image();
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0, deviation);
    for (float& z : depth) z += noise(random);
    const auto expected = static_cast<double>(deviation);
    EXPECT_NEAR(measure_depth_noise(depth, 1e-5), expected, 0.2 * expected);
  }
}

TEST(MeasureDepthNoise, IsAtLeastTheQuantization) {
  EXPECT_NEAR(measure_depth_noise(cv::Mat1f(60, 80, 1.0f), 0.001), 0.001 / std::sqrt(12.0), 1e-9);
  EXPECT_NEAR(measure_depth_noise(cv::Mat1f(60, 80, kNaN), 0.001), 0.001 / std::sqrt(12.0), 1e-9);
}

TEST(PreprocessDepth, FillsFlagsAndSmoothsInsideTheMaskOnly) {
  LightStack stack = test::empty_stack();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.002);
  const cv::Rect hole(20, 20, 6, 5);
  stack.frames.push_back(test::depth_frame(stack, [&](int u, int v) {
    const double z = ramp(u, v) + noise(random);
    return hole.contains({u, v}) ? 0 : z;
  }));
  cv::Mat1b mask(60, 80, uchar{0});
  mask(cv::Rect(10, 10, 55, 45)).setTo(255);
  const SensorDepth found = preprocess_depth(stack, mask, {});
  EXPECT_EQ(found.frames, 1);
  EXPECT_NEAR(found.noise_m, 0.002, 0.0004);
  EXPECT_EQ(cv::countNonZero(found.inpainted), hole.area());
  double squares = 0;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const cv::Point at(u, v);
      EXPECT_EQ(std::isnan(found.smooth(at)), mask(at) == 0);
      EXPECT_EQ(std::isnan(found.measured(at)), mask(at) == 0 || hole.contains(at));
      EXPECT_EQ(found.inpainted(at) != 0, hole.contains(at));
      if (mask(at) == 0) continue;
      const double error = static_cast<double>(found.smooth(at)) - ramp(u, v);
      EXPECT_LT(std::abs(error), 0.006);
      squares += error * error;
    }
  }
  EXPECT_LT(std::sqrt(squares / cv::countNonZero(mask)), 0.5 * 0.002);
}

TEST(PreprocessDepth, KeepsAStepThatIsFarAboveTheNoise) {
  LightStack stack = test::empty_stack();
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.001);
  stack.frames.push_back(
      test::depth_frame(stack, [&](int u, int) { return (u < 40 ? 0.9 : 1.0) + noise(random); }));
  const SensorDepth found = preprocess_depth(stack, cv::Mat1b(60, 80, uchar{255}), {});
  EXPECT_NEAR(static_cast<double>(found.smooth(30, 39)), 0.9, 0.002);
  EXPECT_NEAR(static_cast<double>(found.smooth(30, 40)), 1.0, 0.002);
}

TEST(PreprocessDepth, RefusesAMaskWithoutAnyReading) {
  LightStack stack = test::empty_stack();
  stack.frames.push_back(test::depth_frame(stack, [](int u, int) { return u < 40 ? 1.0 : 0.0; }));
  cv::Mat1b mask(60, 80, uchar{0});
  mask(cv::Rect(50, 10, 20, 20)).setTo(255);
  EXPECT_THAT(test::message_of<InputError>([&] { preprocess_depth(stack, mask, {}); }),
              testing::HasSubstr("no depth reading inside the mask"));
  stack.frames.clear();
  EXPECT_THAT(test::message_of<InputError>([&] { preprocess_depth(stack, mask, {}); }),
              testing::HasSubstr("no depth frame"));
}

TEST(UpsampleLogDepth, FollowsARampBetweenTheCoarsePixels) {
  const cv::Mat1f fine = upsample_log_depth(ramp_image(), 2);
  ASSERT_EQ(fine.size(), cv::Size(160, 120));
  for (int v = 10; v < 110; ++v) {
    for (int u = 10; u < 150; ++u) {
      const double z = 1.0 + 0.002 * ((u + 0.5) / 2 - 0.5) - 0.001 * ((v + 0.5) / 2 - 0.5);
      EXPECT_NEAR(static_cast<double>(fine(v, u)), std::log(z), 2e-4);  // OpenCV's cubic ripples on a ramp
    }
  }
}

TEST(UpsampleLogDepth, HasAValueEverywhere) {
  cv::Mat1f depth = ramp_image();
  depth(cv::Rect(0, 0, 30, 60)).setTo(kNaN);
  for (const int scale : {1, 2, 4}) EXPECT_TRUE(cv::checkRange(upsample_log_depth(depth, scale)));
}

}  // namespace
}  // namespace rakelight
