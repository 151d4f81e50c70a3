// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/clock_fit.h"

#include <gtest/gtest.h>

#include <random>

namespace rakelight {
namespace {

constexpr std::int64_t kPeriod_us = 33333;

/// Adds `count` frames from number `first` on, each late by 0 to `jitter_us` on top of 15 ms, on a device whose clock
/// runs faster by `drift`.
void add_frames(ClockFit& fit, int first, int count, double drift, int jitter_us,
                std::int64_t device_zero_us = 0) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> late(0, jitter_us);
  for (int k = first; k < first + count; ++k) {
    const double since = double(k) * kPeriod_us;
    fit.add(device_zero_us + std::llround(since * (1 + drift)), std::llround(since) + 15000 + late(random));
  }
}

TEST(ClockFit, FollowsTheEarliestArrivalsAndNotTheLateOnes) {
  ClockFit fit;
  add_frames(fit, 0, 100, 0, 20000);
  EXPECT_NEAR(fit.host_at(50 * kPeriod_us), 50 * kPeriod_us + 15000, 1000);
  const double before = fit.host_at(0);
  fit.add(100 * kPeriod_us, 100 * kPeriod_us + 900000);  // held up on its way
  EXPECT_EQ(fit.host_at(0), before);
}

TEST(ClockFit, DoesNotTakeJitterForDriftInAShortSpan) {
  ClockFit fit;
  add_frames(fit, 0, 60, 0, 20000);
  EXPECT_EQ(fit.drift(), 0);
}

TEST(ClockFit, LearnsTheDriftOverTheTime) {
  ClockFit fit;
  add_frames(fit, 0, 900, 1e-4, 2000);
  EXPECT_NEAR(fit.drift(), -1e-4, 2e-5);
  const double device_us = 899.0 * kPeriod_us * (1 + 1e-4);
  EXPECT_NEAR(fit.host_at(std::llround(device_us)), 899.0 * kPeriod_us + 15000, 500);
}

TEST(ClockFit, CountsOnOverAWrapOfTheDevicesCounter) {
  ClockFit fit;
  constexpr std::int64_t kWrap_us = 71'582'788;
  const std::int64_t before = fit.add(kWrap_us - 10000, 1'000'000);
  EXPECT_EQ(fit.add(23333, 1'000'000 + kPeriod_us), before + kPeriod_us);
  EXPECT_EQ(fit.epoch(), 0);
}

TEST(ClockFit, BeginsAnEpochWhenTheDevicesClockIsSetAnew) {
  ClockFit fit;
  add_frames(fit, 0, 30, 0, 0, 5'000'000);
  const std::int64_t before = fit.add(5'000'000 + 30 * kPeriod_us, 30 * kPeriod_us + 15000);
  const std::int64_t after = fit.add(0, 31 * kPeriod_us + 15000);
  EXPECT_EQ(fit.epoch(), 1);
  EXPECT_EQ(after, before + kPeriod_us) << "the time line goes on";
  EXPECT_NEAR(fit.host_at(after), 31 * kPeriod_us + 15000, 1);
}

}  // namespace
}  // namespace rakelight
