// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/rolling_shutter.h"

#include <gtest/gtest.h>

namespace rakelight {
namespace {

LampTimeline two_lamps() {
  LampWiring wiring;
  wiring.lamps = 2;
  wiring.latency_us = 0;
  return LampTimeline(wiring);
}

const RollingShutter kShutter{100, 8000, 30000};  // rows, exposure, readout: a row every 300 us

TEST(RollingShutter, AFrameUnderOneLampIsLitInEveryRowForTheExposure) {
  LampTimeline lamps = two_lamps();
  lamps.write(0, {false, true});
  const auto light = frame_light(lamps, kShutter, 1000);
  ASSERT_EQ(light.size(), 1u);
  EXPECT_EQ(light[0].lamp, 1u);
  for (const float lit : light[0].lit_us) EXPECT_FLOAT_EQ(lit, 8000);
}

TEST(RollingShutter, AnEdgeWithinTheFrameSplitsTheRowsByWhenTheyWereOpen) {
  LampTimeline lamps = two_lamps();
  lamps.write(0, {true, false});
  lamps.write(15000, {false, true});
  const auto light = frame_light(lamps, kShutter, 0);
  ASSERT_EQ(light.size(), 2u);
  EXPECT_FLOAT_EQ(light[0].lit_us[0], 8000);   // open in [0, 8000)
  EXPECT_FLOAT_EQ(light[0].lit_us[40], 3000);  // open in [12000, 20000)
  EXPECT_FLOAT_EQ(light[1].lit_us[40], 5000);
  EXPECT_FLOAT_EQ(light[1].lit_us[99], 8000);  // opens at 29700
  for (std::size_t row = 0; row < 100; ++row) {
    EXPECT_NEAR(light[0].lit_us[row] + light[1].lit_us[row], 8000, 0.01) << row;
  }
}

TEST(RollingShutter, ALampThatWasLitBeforeAndAfterIsNotMentioned) {
  LampTimeline lamps = two_lamps();
  lamps.write(0, {true, false});
  lamps.write(10000, {false, false});
  lamps.write(10000 + kShutter.span_us(), {true, false});
  EXPECT_TRUE(frame_light(lamps, kShutter, 10000).empty());
}

}  // namespace
}  // namespace rakelight
