// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/albedo.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

namespace rakelight {
namespace {

class EveryAlbedo : public testing::TestWithParam<AlbedoKind> {};

/// Distinct colours (8 bits) and the share of neighbours that differ, on a lattice of the object's face.
std::pair<std::size_t, double> variety(AlbedoKind kind, std::uint64_t seed = 1) {
  std::set<std::tuple<int, int, int>> colors;
  int changes = 0, count = 0;
  std::tuple<int, int, int> last;
  for (int v = 0; v < 200; ++v) {
    for (int u = 0; u < 200; ++u, ++count) {
      const Eigen::Vector3f rgb =
          255 * albedo_at(kind, {static_cast<float>(u) / 100 - 1, static_cast<float>(v) / 100 - 1}, seed);
      const std::tuple<int, int, int> color(rgb.x(), rgb.y(), rgb.z());
      colors.insert(color);
      if (u > 0 && color != last) ++changes;
      last = color;
    }
  }
  return {colors.size(), static_cast<double>(changes) / count};
}

TEST_P(EveryAlbedo, StaysWithinWhatPaintReflects) {
  for (int k = 0; k < 40000; ++k) {
    const Eigen::Vector2f at(static_cast<float>(k % 200) / 50 - 2, static_cast<float>(k / 200) / 50 - 2);
    const Eigen::Vector3f rgb = albedo_at(GetParam(), at, 1);
    ASSERT_GE(rgb.minCoeff(), 0.08f);
    ASSERT_LE(rgb.maxCoeff(), 0.92f);
  }
}

INSTANTIATE_TEST_SUITE_P(Paints, EveryAlbedo,
                         testing::Values(AlbedoKind::simple, AlbedoKind::pattern, AlbedoKind::complicated));

TEST(Albedo, SimpleIsAFewColoursInLargeRegions) {
  const auto [colors, changes] = variety(AlbedoKind::simple);
  EXPECT_LE(colors, 4U);
  EXPECT_GE(colors, 2U);
  EXPECT_LT(changes, 0.03);
}

TEST(Albedo, PatternIsSeveralColoursInSmallOnes) {
  const auto [colors, changes] = variety(AlbedoKind::pattern);
  EXPECT_GE(colors, 5U);
  EXPECT_LE(colors, 12U);
  EXPECT_GT(changes, 0.08);
}

TEST(Albedo, ComplicatedIsDenseAndOfManyColours) {
  const auto [colors, changes] = variety(AlbedoKind::complicated);
  EXPECT_GT(colors, 2000U);
  EXPECT_GT(changes, 0.8);
}

}  // namespace
}  // namespace rakelight
