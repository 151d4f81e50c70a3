// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/frame_schedule.h"

#include <gtest/gtest.h>

namespace rakelight {
namespace {

TEST(FrameSchedule, FramesArriveAfterTheirLastRowWithinTheJitter) {
  FrameScheduleOptions options;
  options.period_us = 33333;
  options.delivery_latency_us = 15000;
  options.delivery_jitter_us = 2000;
  const FrameSchedule schedule(options);
  for (int k = 0; k < 200; ++k) {
    const double delay = schedule.arrival_us(k, 38000) - (33333.0 * k + 38000);
    EXPECT_GE(delay, 15000);
    EXPECT_LT(delay, 17000);
  }
}

TEST(FrameSchedule, FramesDoNotOvertakeHoweverLargeTheJitter) {
  FrameScheduleOptions options;
  options.delivery_jitter_us = 80000;
  const FrameSchedule schedule(options);
  double before = 0;
  for (int k = 0; k < 500; ++k) {
    const double arrival = schedule.arrival_us(k, 38000);
    EXPECT_GE(arrival, before);
    EXPECT_LT(arrival, schedule.start_us(k) + 38000 + options.delivery_latency_us + 80000);
    before = arrival;
  }
}

TEST(FrameSchedule, TheAskedShareOfFramesIsDroppedAndStreamsDropApart) {
  FrameScheduleOptions options;
  options.drop_share = 0.05;
  const FrameSchedule color(options);
  options.stream = 1;
  const FrameSchedule depth(options);
  int dropped = 0, both = 0;
  for (int k = 0; k < 10000; ++k) {
    dropped += color.dropped(k);
    both += color.dropped(k) && depth.dropped(k);
  }
  EXPECT_NEAR(dropped, 500, 100);
  EXPECT_LT(both, 100);
}

}  // namespace
}  // namespace rakelight
