// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/color_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rakelight {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

const ColorRange kSigned{ColorScale::signed_, -2, 2, "", ""};
const ColorRange kSequential{ColorScale::sequential, 10, 20, "", ""};

TEST(ColorMap, SignedScaleIsBlueBelowWhiteAtAndRedAboveZero) {
  EXPECT_EQ(color_of(kSigned, 0), cv::Vec3b(247, 247, 247));
  const cv::Vec3b minus = color_of(kSigned, -2), plus = color_of(kSigned, 2);
  EXPECT_GT(minus[2], minus[0]);
  EXPECT_GT(plus[0], plus[2]);
  EXPECT_EQ(color_of(kSigned, 50), plus);
}

TEST(ColorMap, SequentialScaleGrowsInLightness) {
  double last = -1;
  for (double value = 10; value <= 20; value += 0.5) {
    const cv::Vec3b c = color_of(kSequential, value);
    const double lightness = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    EXPECT_GT(lightness, last);
    last = lightness;
  }
}

TEST(ColorMap, WhatIsNoNumberIsGrey) {
  const cv::Vec3b c = color_of(kSequential, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(c[0] == c[1] && c[1] == c[2]);
}

TEST(ColorMap, RoundsUpToOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_up(0.03), 0.05);
  EXPECT_DOUBLE_EQ(round_up(2), 2);
  EXPECT_DOUBLE_EQ(round_up(6), 10);
  EXPECT_DOUBLE_EQ(round_up(0), 1);
}

TEST(ColorMap, RangesLeaveOutliersAndGapsOut) {
  std::vector<float> values(1000, 0.3f);
  values[0] = 100;
  values[1] = std::numeric_limits<float>::quiet_NaN();
  const ColorRange range = signed_range(values, "error", "mm");
  EXPECT_DOUBLE_EQ(range.low, -0.5);
  EXPECT_DOUBLE_EQ(range.high, 0.5);
  const ColorRange flat = sequential_range(values, "depth", "mm");
  EXPECT_GT(flat.high, flat.low);
  EXPECT_LT(flat.high, 1);
}

TEST(ColorMap, TicksAreRoundNumbersInsideTheRange) {
  const auto near = [](double value) { return DoubleNear(value, 1e-9); };
  EXPECT_THAT(ticks(kSigned), ElementsAre(near(-2), near(-1), near(0), near(1), near(2)));
  EXPECT_THAT(ticks(kSequential), ElementsAre(near(10), near(12), near(14), near(16), near(18), near(20)));
}

}  // namespace
}  // namespace rakelight
