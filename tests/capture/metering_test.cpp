// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/metering.h"

#include <gtest/gtest.h>

namespace rakelight {
namespace {

const ExposureSetting kStart{8000, 100};

TEST(Metering, KeepsAnExposureThatIsRight) {
  EXPECT_FALSE(better_exposure({0.005, 0.8}, kStart, kStart, {}));
}

TEST(Metering, ExposesForLessWhereTooMuchSaturates) {
  const auto better = better_exposure({0.02, 1}, kStart, kStart, {});
  ASSERT_TRUE(better);
  EXPECT_LT(better->time_us, kStart.time_us);
  EXPECT_EQ(better->gain, kStart.gain);
  const auto much_better = better_exposure({0.5, 1}, kStart, kStart, {});
  EXPECT_LT(much_better->time_us, better->time_us) << "the more saturates the more is taken away";
}

TEST(Metering, ExposesForLongerAndThenAmplifiesWhereTheBrightestLampIsDim) {
  const auto better = better_exposure({0, 0.2}, kStart, kStart, {});
  ASSERT_TRUE(better);
  EXPECT_NEAR(better->time_us * better->gain, 3.5 * kStart.time_us * kStart.gain, 1) << "from 0.2 to 0.7";
  const auto longest = better_exposure({0, 0.2}, {32000, 100}, kStart, {});
  EXPECT_EQ(longest->time_us, 32000);
  EXPECT_NEAR(longest->gain, 350, 1e-6);
}

TEST(Metering, StaysWithinTheLimitsOfTimeAndGain) {
  const MeteringLimits limits;
  const auto darkest = better_exposure({0.9, 1}, {1000, 40}, kStart, limits);
  ASSERT_TRUE(darkest);
  EXPECT_EQ(darkest->time_us, limits.min_time_us);
  EXPECT_EQ(darkest->gain, kStart.gain / limits.max_gain_factor);
  EXPECT_FALSE(better_exposure({0.9, 1}, {limits.min_time_us, 25}, kStart, limits))
      << "it cannot be bettered";
}

/// A wall of 80 x 60 cells at 1 m that fills the picture.
CoarseScene wall(const LightStack& stack) {
  return coarse_scene(stack, {cv::Mat1w(stack.depth_camera.size(), std::uint16_t{1000})});
}

TEST(Metering, TakesTheLampThatSaturatesMostAndTheObjectOnly) {
  LightStack stack;
  stack.color_camera = stack.depth_camera = {160, 120, 142, 142, 79.5, 59.5, {}};
  const CoarseScene scene = wall(stack);
  cv::Mat1b object(scene.size, uchar{0});
  object.colRange(0, scene.size.width / 2).setTo(255);
  cv::Mat dim(120, 160, CV_8UC3, cv::Scalar(51, 51, 51)), bright = dim.clone();
  bright(cv::Rect(0, 0, 80, 12)).setTo(cv::Scalar(255, 255, 255));    // a tenth of the object
  bright(cv::Rect(80, 0, 80, 120)).setTo(cv::Scalar(255, 255, 255));  // none of it
  const Brightness seen = measure_brightness(scene, object, {dim, bright}, ColorResponse());
  EXPECT_NEAR(seen.saturated, 0.1, 0.02);
  EXPECT_NEAR(seen.level, 1, 1e-3);
  EXPECT_NEAR(measure_brightness(scene, object, {dim}, ColorResponse()).level, 0.2, 0.01);
}

}  // namespace
}  // namespace rakelight
