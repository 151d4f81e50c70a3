// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo_palette.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rakelight {
namespace {

/// 600 pixels of three paints that differ by more than the bandwidth, each within .05 of its paint.
Eigen::Matrix3Xd three_paints() {
  Eigen::Matrix3Xd colors(3, 600);
  for (int p = 0; p < 600; ++p) {
    const Eigen::Vector3d paints[] = {{0, 0, 0}, {-1, 0, 0.2}, {0.5, -0.8, -1}};
    colors.col(p) = paints[p % 3] + 0.05 * Eigen::Vector3d(std::sin(p), std::cos(1.7 * p), std::sin(2.3 * p));
  }
  return colors;
}

TEST(Palette, FindsThePaintsOfAnObject) {
  const Eigen::Matrix3Xd modes = palette_modes(three_paints(), 0.25);
  ASSERT_EQ(modes.cols(), 3);
  for (const Eigen::Vector3d& paint :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-1, 0, 0.2), Eigen::Vector3d(0.5, -0.8, -1)})
    EXPECT_LT((modes.colwise() - paint).colwise().norm().minCoeff(), 0.02);
}

TEST(Palette, PullsAPixelToItsPaintAndLeavesStrangersAlone) {
  Eigen::Matrix3Xd colors = three_paints();
  colors.col(5) << 3, 3, 3;  // one pixel is no paint
  const PalettePull pull = palette_pull(colors, 0.25);
  EXPECT_LT((pull.color.col(1) - Eigen::Vector3d(-1, 0, 0.2)).norm(), 0.02);
  EXPECT_GT(pull.trust[1], 0.9);
  EXPECT_LT(pull.trust[5], 1e-6);
}

TEST(Palette, OfOneColourIsThatColour) {
  const Eigen::Matrix3Xd modes = palette_modes(Eigen::Matrix3Xd::Constant(3, 50, -0.7), 0.25);
  ASSERT_EQ(modes.cols(), 1);
  EXPECT_LT((modes.col(0).array() + 0.7).abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace rakelight
