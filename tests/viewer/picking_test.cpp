// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/picking.h"

#include <gtest/gtest.h>

#include "tests/viewer/bump_result.h"
#include "viewer/viewer.h"

namespace rakelight {
namespace {

const Scene kScene = test::bump_scene();

TEST(Picking, FindsThePointOfThePixelTheRayGoesThrough) {
  const Layer& layer = *kScene.find(LayerKind::refined);
  const Surface surface = surface_of(layer, "bump");
  const Eigen::Vector3d point((100 - layer.camera.cx) / layer.camera.fx,
                              (40 - layer.camera.cy) / layer.camera.fy, 1);
  const auto picked = pick(surface, {Eigen::Vector3d::Zero(), point.normalized()});
  ASSERT_TRUE(picked.has_value());
  EXPECT_EQ(picked->pixel, cv::Point(100, 40));
  EXPECT_NEAR((picked->point - static_cast<double>(layer.depth(40, 100)) * point).norm(), 0, 1e-6);
}

TEST(Picking, TakesTheNearestOfSeveralSurfaces) {
  const Surface surface = surface_of(*kScene.find(LayerKind::refined), "bump");
  const Ray across{{-1, 0, 0.495}, {1, 0, 0}};  // through the bump, 5 mm above the plane: in on the left side
  const auto picked = pick(surface, across);
  ASSERT_TRUE(picked.has_value());
  EXPECT_LT(picked->point.x(), 0);
}

TEST(Picking, MissesBesideTheSurfaceAndBehindTheEye) {
  const Surface surface = surface_of(*kScene.find(LayerKind::refined), "bump");
  EXPECT_FALSE(pick(surface, {Eigen::Vector3d::Zero(), Eigen::Vector3d(1, 0, 0.1).normalized()}).has_value());
  EXPECT_FALSE(pick(surface, {Eigen::Vector3d::Zero(), Eigen::Vector3d(0, 0, -1)}).has_value());
}

}  // namespace
}  // namespace rakelight
