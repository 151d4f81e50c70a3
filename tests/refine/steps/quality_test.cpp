// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each warning: silent on a sound scan, spoken on one with that fault alone.
#include "refine/steps/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "refine/refine.h"
#include "tests/support/bump_stack.h"

namespace rakelight {
namespace {

using test::bump_stack;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

RefineResult refined(const LightStack& stack) {
  RefineOptions options = preset_options(Preset::robust);
  options.scale = 1;
  options.max_iterations = 20;
  return refine_depth(stack, options);
}

Frame dark_frame(const LightStack& stack, int index, double level) {
  Frame frame;
  frame.index = index;
  frame.color = cv::Mat(stack.color_camera.size(), CV_16UC3, cv::Scalar::all(65535 * level));
  return frame;
}

/// The stack under ambient light of `level`, with a dark frame before and one after; the later one is brighter by `drift`.
LightStack with_ambient(double level, double drift) {
  LightStack stack = bump_stack();
  for (Frame& frame : stack.frames) frame.color += cv::Scalar::all(65535 * level);
  stack.frames.push_back(dark_frame(stack, 8, level));
  stack.frames.push_back(dark_frame(stack, 9, level + drift));
  return stack;
}

TEST(Quality, ASoundScanRaisesNoWarning) {
  EXPECT_THAT(refined(bump_stack()).warnings, IsEmpty());
  EXPECT_THAT(refined(with_ambient(0.02, 0)).warnings, IsEmpty());
}

TEST(Quality, AnObjectThatMovedBetweenDepthFramesIsNamed) {
  LightStack stack = bump_stack();
  const auto ten_mm = static_cast<ushort>(0.010 / stack.depth_unit_m);
  cv::add(stack.frames[5].depth, cv::Scalar(ten_mm), stack.frames[5].depth, stack.frames[5].depth > 0);
  EXPECT_THAT(refined(stack).warnings, Contains(HasSubstr("depth frame 5 lies 10.")));
}

TEST(Quality, AmbientLightThatDriftedIsReportedWithItsAmount) {
  EXPECT_THAT(refined(with_ambient(0.02, 0.03)).warnings,
              Contains(HasSubstr("ambient light drifted by 0.030 of full scale")));
  EXPECT_THAT(refined(with_ambient(0.02, 0.004)).warnings, IsEmpty());
}

TEST(Quality, AnImageThatDoesNotFitTheOthersIsNamed) {
  LightStack stack = bump_stack();
  cv::Mat& color = stack.frames[3].color;
  for (int u = 0; u + 8 <= color.cols; u += 16)
    color(cv::Rect(u, 0, 8, color.rows)) *= 0.5;  // shadows of a blind
  const RefineResult result = refined(stack);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("frame 3 (light lamp-3) does not fit the others")));
  EXPECT_GT(result.quality.at("worst_image_misfit"), 2.5);
}

/// Light adds up: shares of three lamps of the ring, lit at once.
cv::Mat mixture(const LightStack& ring, double lamp0, double lamp2, double lamp4) {
  cv::Mat sum;
  cv::addWeighted(ring.frames[0].color, lamp0, ring.frames[4].color, lamp4, 0, sum);
  cv::addWeighted(sum, 1, ring.frames[2].color, lamp2, 0, sum);
  return sum;
}

TEST(Quality, LampsNearlyInOnePlaneAreReported) {
  const LightStack ring = bump_stack();
  LightStack stack = ring;
  stack.frames.resize(6);
  for (size_t k = 0; k < 6; ++k) {
    const double share = 0.2 * static_cast<double>(k), aside = k % 2 == 0 ? 0.2 : 0.0;
    stack.frames[k].color = mixture(ring, (1 - aside) * (1 - share), aside, (1 - aside) * share);
  }
  const RefineResult result = refined(stack);
  EXPECT_LT(result.quality.at("lamp_spread"), 0.1);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("nearly in one plane")));
}

TEST(Quality, SurfaceThatTooFewLampsReachIsReportedWithItsShare) {
  LightStack stack = bump_stack();
  for (size_t k = 0; k < 6; ++k) stack.frames[k].color(cv::Rect(0, 0, 96, 24)).setTo(cv::Scalar::all(65535));
  const RefineResult result = refined(stack);
  EXPECT_GT(result.quality.at("too_few_lit"), 0.15);
  EXPECT_THAT(result.warnings, Contains(HasSubstr("lit in fewer than three images")));
}

TEST(Quality, CoverageIsTheShareOfTheSurfaceWithAReading) {
  LightStack stack = bump_stack();
  EXPECT_EQ(refined(stack).quality.at("coverage"), 1);
  const cv::Rect hole(20, 12, 6, 5);
  for (Frame& frame : stack.frames) frame.depth(hole).setTo(0);
  const RefineResult result = refined(stack);
  EXPECT_NEAR(result.quality.at("coverage"), 1 - 30.0 / cv::countNonZero(result.depth > 0), 1e-9);
}

TEST(Quality, TheUncertaintyMapCountsTheImagesThatLightAPixel) {
  LightStack stack = bump_stack();
  for (size_t k = 0; k < 3; ++k) stack.frames[k].color(cv::Rect(0, 0, 96, 36)).setTo(cv::Scalar::all(65535));
  const RefineResult result = refined(stack);
  const auto lit = [&](int v) { return result.uncertainty(v, 24)[2]; };
  EXPECT_LT(lit(9), 5.01f);
  EXPECT_GT(lit(27), 5.5f);
}

}  // namespace
}  // namespace rakelight
