// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/counter_random.h"

#include <gtest/gtest.h>

namespace rakelight {
namespace {

TEST(CounterRandom, NormalNumbersHaveZeroMeanAndUnitVariance) {
  const CounterRandom random(3, 5);
  constexpr int kCount = 200000;
  double sum = 0, squares = 0;
  for (std::uint64_t k = 0; k < kCount; ++k) {
    const double value = random.normal(k);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.015);
}

TEST(CounterRandom, NeighbouringSeedsStreamsAndIndicesAreUncorrelated) {
  constexpr int kCount = 100000;
  const CounterRandom base(1, 1), other_seed(2, 1), other_stream(1, 2);
  double seeds = 0, streams = 0, indices = 0;
  for (std::uint64_t k = 0; k < kCount; ++k) {
    seeds += base.normal(k) * other_seed.normal(k);
    streams += base.normal(k) * other_stream.normal(k);
    indices += base.normal(k) * base.normal(k + 1);
  }
  for (const double product : {seeds, streams, indices}) EXPECT_NEAR(product / kCount, 0.0, 0.015);
}

TEST(CounterRandom, UniformNumbersStayInTheirRange) {
  const CounterRandom random(1, 1);
  double low = 1, high = 0;
  for (std::uint64_t k = 0; k < 10000; ++k) {
    low = std::min(low, random.uniform(k));
    high = std::max(high, random.uniform(k));
  }
  EXPECT_GE(low, 0.0);
  EXPECT_LT(high, 1.0);
  EXPECT_LT(low, 0.001);
  EXPECT_GT(high, 0.999);
}

}  // namespace
}  // namespace rakelight
