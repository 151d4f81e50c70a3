// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/orbit_camera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace rakelight {
namespace {

constexpr double kPi = 3.14159265358979323846;
const Box kBox{{-0.2, -0.1, 0.9}, {0.2, 0.1, 1.1}};

OrbitCamera fitted(bool orthographic = false) {
  OrbitCamera camera;
  camera.orthographic = orthographic;
  fit(camera, kBox, 1.5);
  return camera;
}

Eigen::Vector3d through_matrices(const OrbitCamera& camera, double aspect, const Eigen::Vector3d& point) {
  const Eigen::Vector4d clip =
      projection_matrix(camera, aspect, kBox) * view_matrix(camera) * point.homogeneous();
  return clip.hnormalized();
}

TEST(OrbitCamera, SeesAtFirstWhatTheSensorSaw) {
  const OrbitCamera camera = fitted();
  const auto right = project(camera, 1.5, {0.1, 0, 1}), below = project(camera, 1.5, {0, 0.05, 1});
  EXPECT_GT(right->x(), 0);
  EXPECT_NEAR(right->y(), 0, 1e-12);
  EXPECT_LT(below->y(), 0);
  EXPECT_LT(through_matrices(camera, 1.5, {0, 0, 0.95}).z(), through_matrices(camera, 1.5, {0, 0, 1.05}).z());
}

class OrbitCameraProjection : public testing::TestWithParam<bool> {};

TEST_P(OrbitCameraProjection, ProjectsAsItsMatricesDo) {
  OrbitCamera camera = fitted(GetParam());
  orbit(camera, 0.2, -0.1);
  pan(camera, 0.05, 0.02);
  const Eigen::Vector3d point(0.07, -0.03, 1.04);
  const auto projected = project(camera, 1.5, point);
  EXPECT_NEAR((*projected - through_matrices(camera, 1.5, point).head<2>()).norm(), 0, 1e-12);
}

TEST_P(OrbitCameraProjection, ARayMeetsThePointThatProjectsThere) {
  OrbitCamera camera = fitted(GetParam());
  orbit(camera, -0.3, 0.15);
  const Eigen::Vector3d point(-0.11, 0.06, 0.97);
  const auto at = project(camera, 1.5, point);
  const Ray ray = ray_through(camera, 1.5, at->x(), at->y());
  EXPECT_NEAR(ray.direction.cross(point - ray.origin).norm(), 0, 1e-12);
}

TEST_P(OrbitCameraProjection, FitsTheBoxJustInsideFromEverySide) {
  for (const double azimuth : {0.0, 0.7, 2.0}) {
    OrbitCamera camera;
    camera.orthographic = GetParam();
    camera.azimuth = azimuth;
    camera.elevation = 0.3;
    fit(camera, kBox, 1.5);
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d point((corner & 1) != 0 ? 0.2 : -0.2, (corner & 2) != 0 ? 0.1 : -0.1,
                                  (corner & 4) != 0 ? 1.1 : 0.9);
      const Eigen::Vector3d seen = through_matrices(camera, 1.5, point);
      farthest = std::max(farthest, seen.head<2>().cwiseAbs().maxCoeff());
      EXPECT_LE(std::abs(seen.z()), 1) << "the near or far plane cuts the box";
    }
    EXPECT_LE(farthest, 1);
    EXPECT_GE(farthest, 0.85);
  }
}

INSTANTIATE_TEST_SUITE_P(, OrbitCameraProjection, testing::Bool(),
                         [](const auto& test) { return test.param ? "Orthographic" : "Perspective"; });

TEST(OrbitCamera, DraggingRightTurnsTheObjectToTheRight) {
  OrbitCamera camera = fitted();
  const Eigen::Vector3d nearest(0, 0, 0.9);
  orbit(camera, 0.1, 0);
  EXPECT_GT(project(camera, 1.5, nearest)->x(), 0);
  camera = fitted();
  orbit(camera, 0, 0.1);  // down
  EXPECT_LT(project(camera, 1.5, nearest)->y(), 0);
}

TEST(OrbitCamera, CannotTumbleOverThePoles) {
  OrbitCamera camera = fitted();
  orbit(camera, 0, 5);
  EXPECT_DOUBLE_EQ(camera.elevation, kPi / 2);
}

TEST(OrbitCamera, PanningMovesTheTargetWithTheMouse) {
  OrbitCamera camera = fitted();
  orbit(camera, 0.2, 0.1);
  const Eigen::Vector3d target = camera.target;
  pan(camera, 0.1, -0.2);
  const auto now = project(camera, 1.5, target);
  EXPECT_NEAR(now->x(), 2 * 0.1 / 1.5, 1e-12);
  EXPECT_NEAR(now->y(), 2 * 0.2, 1e-12);
}

TEST(OrbitCamera, ZoomingKeepsThePointUnderTheMouse) {
  OrbitCamera camera = fitted();
  orbit(camera, 0.1, 0.05);
  const Ray ray = ray_through(camera, 1.5, 0.4, -0.3);
  const Eigen::Vector3d back = (view_matrix(camera).row(2).head<3>()).transpose();
  const double along = (camera.target - ray.origin).dot(back) / ray.direction.dot(back);
  const Eigen::Vector3d point = ray.origin + along * ray.direction;  // in the target's plane
  zoom(camera, 0.5, 0.4 * 1.5 / 2, 0.3 / 2);
  const auto now = project(camera, 1.5, point);
  EXPECT_NEAR(now->x(), 0.4, 1e-9);
  EXPECT_NEAR(now->y(), -0.3, 1e-9);
}

TEST(OrbitCamera, StandardViewsLookAlongTheAxes) {
  OrbitCamera camera = fitted();
  turn_to(camera, StandardView::right);  // from +x
  EXPECT_NEAR(view_matrix(camera)(2, 0), 1, 1e-12);
  turn_to(camera, StandardView::top);  // from above, -y
  EXPECT_NEAR(view_matrix(camera)(2, 1), -1, 1e-12);
  turn_to(camera, StandardView::back);
  EXPECT_NEAR(view_matrix(camera)(2, 2), 1, 1e-12);
}

TEST(OrbitCamera, SeesNothingBehindTheEye) { EXPECT_FALSE(project(fitted(), 1.5, {0, 0, -5}).has_value()); }

}  // namespace
}  // namespace rakelight
