// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/lamp_timeline.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace rakelight {
namespace {

LampWiring three_lamps() {
  LampWiring wiring;
  wiring.lamps = 3;
  wiring.latency_us = 1000;
  return wiring;
}

const std::vector<bool> kNone{false, false, false}, kFirst{true, false, false}, kLast{false, false, true};

TEST(LampTimeline, ALampIsLitFromItsWriteToTheNextBothLateByTheLatency) {
  LampTimeline lamps(three_lamps());
  lamps.write(10000, kFirst);
  lamps.write(20000, kLast);
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 0, 50000), 10000);
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 0, 11000), 0);
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 12000, 15000), 3000);
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 20000, 25000), 1000);
  EXPECT_DOUBLE_EQ(lamps.lit_us(1, 0, 50000), 0);
  EXPECT_DOUBLE_EQ(lamps.lit_us(2, 0, 50000), 50000 - 21000);
}

TEST(LampTimeline, WritingTheSameLevelsAgainChangesNothing) {
  LampTimeline lamps(three_lamps());
  lamps.write(0, kFirst);
  lamps.write(5000, kFirst);
  lamps.write(10000, kNone);
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 0, 50000), 10000);
}

TEST(LampTimeline, JitterDelaysEachEdgeAnewAndNeverTurnsTheOrderRound) {
  LampWiring wiring = three_lamps();
  wiring.jitter_us = 3000;
  LampTimeline lamps(wiring);
  double least = 1e9, most = -1e9;
  for (int k = 0; k < 500; ++k) {
    const double at = 20000.0 * k;
    lamps.write(at, kFirst);
    lamps.write(at + 1000, kNone);  // the two edges' jitters overlap
    const double lit = lamps.lit_us(0, at, at + 20000);
    least = std::min(least, lit), most = std::max(most, lit);
  }
  EXPECT_GE(least, 0);
  EXPECT_LT(least, 200);
  EXPECT_GT(most, 3000);
  EXPECT_LE(most, 4000);
}

TEST(LampTimeline, EqualSeedsGiveEqualEdges) {
  LampWiring wiring = three_lamps();
  wiring.jitter_us = 3000;
  LampTimeline a(wiring), b(wiring);
  wiring.seed = 2;
  LampTimeline other(wiring);
  for (LampTimeline* lamps : {&a, &b, &other}) lamps->write(0, kFirst);
  EXPECT_EQ(a.lit_us(0, 0, 9000), b.lit_us(0, 0, 9000));
  EXPECT_NE(a.lit_us(0, 0, 9000), other.lit_us(0, 0, 9000));
}

TEST(LampTimeline, FaultyLampsDoNotFollowTheirLines) {
  LampWiring wiring = three_lamps();
  wiring.stuck_on = {0};
  wiring.stuck_off = {1};
  wiring.dim = {2};
  LampTimeline lamps(wiring);
  lamps.write(0, {false, true, true});
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 0, 5000), 5000);
  EXPECT_DOUBLE_EQ(lamps.lit_us(1, 2000, 5000), 0);
  EXPECT_NEAR(lamps.lit_us(2, 2000, 5000), kDimBrightness * 3000, 0.01);
}

TEST(LampTimeline, SwappedLampsHangOnEachOthersLines) {
  LampWiring wiring = three_lamps();
  wiring.swapped = {{0, 2}};
  LampTimeline lamps(wiring);
  lamps.write(0, kFirst);
  EXPECT_DOUBLE_EQ(lamps.lit_us(0, 2000, 3000), 0);
  EXPECT_DOUBLE_EQ(lamps.lit_us(2, 2000, 3000), 1000);
}

TEST(LampTimeline, RefusesLampsThatDoNotExist) {
  LampWiring wiring = three_lamps();
  wiring.dim = {3};
  EXPECT_THROW(LampTimeline{wiring}, std::invalid_argument);
  LampTimeline lamps(three_lamps());
  EXPECT_THROW(lamps.write(0, {true}), std::invalid_argument);
}

}  // namespace
}  // namespace rakelight
