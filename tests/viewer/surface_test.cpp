// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "stack/errors.h"
#include "tests/support/message_of.h"
#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

Layer step_layer() {
  Layer layer;
  layer.camera = {8, 6, 100, 100, 3.5, 2.5, {}};
  layer.depth = cv::Mat1f(6, 8, 0.5f);
  layer.depth.colRange(4, 8) = 0.8f;  // a jump of 0.3 m between pixels 5 mm apart
  return layer;
}

TEST(Surface, IsCutAtDepthJumps) {
  const Surface surface = surface_of(step_layer(), "step");
  EXPECT_EQ(surface.positions.size(), 48u);
  EXPECT_EQ(surface.triangles.size(), 2u * (5 * 3 + 5 * 3));
  for (const auto& triangle : surface.triangles) {
    const auto x = [&](int corner) {
      return surface.pixels[static_cast<std::size_t>(triangle[static_cast<std::size_t>(corner)])].x;
    };
    EXPECT_EQ(x(0) < 4, x(1) < 4);
    EXPECT_EQ(x(0) < 4, x(2) < 4);
  }
}

TEST(Surface, PutsEachPixelOnItsRay) {
  const Surface surface = surface_of(step_layer(), "step");
  const cv::Vec3f& last = surface.positions.back();
  EXPECT_NEAR(last[0], 3.5f / 100 * 0.8f, 1e-6f);
  EXPECT_NEAR(last[1], 2.5f / 100 * 0.8f, 1e-6f);
  EXPECT_NEAR(surface.normals.front()[2], -1, 1e-6f);
}

TEST(Surface, LeavesStrayReadingsOutOfItsBounds) {
  Layer layer;
  layer.camera = {60, 50, 100, 100, 29.5, 24.5, {}};
  layer.depth = cv::Mat1f(50, 60, 0.5f);
  layer.depth(10, 10) = 9;
  EXPECT_LT(surface_of(layer, "stray").bounds.high[2], 0.51);
}

TEST(Surface, HasACoarseMeshOverTheSamePointsOnlyIfItIsLarge) {
  EXPECT_TRUE(surface_of(step_layer(), "step").coarse_triangles.empty());
  Layer layer;
  layer.camera = {640, 480, 500, 500, 319.5, 239.5, {}};
  layer.depth = cv::Mat1f(480, 640, 0.5f);
  const Surface surface = surface_of(layer, "plane");
  EXPECT_EQ(surface.coarse_triangles.size(), 2u * 319 * 239) << "every second row and column";
  const auto& last = surface.coarse_triangles.back();
  EXPECT_EQ(surface.pixels[static_cast<std::size_t>(last[0])].y % 2, 0);
}

TEST(Surface, IsRefusedWithoutAPoint) {
  Layer layer = step_layer();
  layer.depth = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(test::message_of<InputError>([&] { surface_of(layer, "scan (sensor depth)"); }),
              HasSubstr("scan (sensor depth): has no surface to show"));
}

TEST(Surface, IsRefusedAboveTheMostThatCanBeDrawn) {
  EXPECT_NO_THROW(check_point_count(kMostPoints, "scan"));
  EXPECT_THAT(test::message_of<InputError>([] { check_point_count(20'000'000, "scan"); }),
              HasSubstr("scan: has 20000000 points, more than the 12000000"));
}

}  // namespace
}  // namespace rakelight
