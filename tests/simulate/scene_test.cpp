// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "simulate/render.h"
#include "tests/simulate/small_rig.h"

namespace rakelight {
namespace {

using test::ideal_rig;

/// The view of depth pixels at 320 x 240: fine enough meshes for tight bounds.
SimulateOptions fine(SceneKind kind) {
  SimulateOptions options = ideal_rig(kind);
  options.width = 320;
  options.height = 240;
  return options;
}

Eigen::Vector3d ray(const Camera& camera, int u, int v) {
  return {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1};
}

TEST(Scene, ASphereHasTheDepthAndNormalsOfItsEquation) {
  const SimulateOptions options = fine(SceneKind::sphere);
  const Simulated scan = simulate_stack(options);
  const Camera& camera = scan.stack.color_camera;
  // The largest ball whose every point stays within the fill of the view touches the view's pyramid.
  const double slope = options.scene.fill * camera.height / 2 / camera.fy;
  const double radius = slope / std::sqrt(1 + slope * slope);
  int checked = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d d = ray(camera, u, v), center(0, 0, 1);
      const double b = d.dot(center) / d.squaredNorm();
      const double discriminant = b * b - (1 - radius * radius) / d.squaredNorm();
      if (discriminant < 5e-3) continue;  // beside or at the rim
      const double z = b - std::sqrt(discriminant);
      ASSERT_NEAR(static_cast<double>(scan.truth.depth(v, u)), z, 4e-5) << u << ", " << v;
      const cv::Vec3f n = scan.truth.normals(v, u);
      const Eigen::Vector3d normal = (z * d - center) / radius;
      ASSERT_GT(normal.dot(Eigen::Vector3d(n[0], n[1], n[2])), std::cos(0.002)) << u << ", " << v;
      ++checked;
    }
  }
  EXPECT_GT(checked, 15000);
}

TEST(Scene, APlaneHasTheDepthAndNormalOfItsEquation) {
  const Simulated scan = simulate_stack(fine(SceneKind::plane));
  const Camera& camera = scan.stack.color_camera;
  const Eigen::Vector3d normal = Eigen::AngleAxisd(25 * M_PI / 180, Eigen::Vector3d::UnitY()) *
                                 Eigen::AngleAxisd(15 * M_PI / 180, Eigen::Vector3d::UnitX()) *
                                 Eigen::Vector3d(0, 0, -1);
  int checked = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (scan.stack.mask(v, u) == 0) continue;
      const double z = normal.z() / normal.dot(ray(camera, u, v));  // through (0, 0, 1)
      ASSERT_NEAR(static_cast<double>(scan.truth.depth(v, u)), z, 1e-6);
      const cv::Vec3f n = scan.truth.normals(v, u);
      ASSERT_GT(normal.dot(Eigen::Vector3d(n[0], n[1], n[2])), 1 - 1e-6);
      ++checked;
    }
  }
  EXPECT_GT(checked, 15000);
}

TEST(Scene, ExactDepthReadingsRoundTheTruth) {
  const Simulated scan = simulate_stack(ideal_rig(SceneKind::sphere));
  const cv::Mat1w& raw = scan.stack.frames.front().depth;
  for (int v = 0; v < raw.rows; ++v) {
    for (int u = 0; u < raw.cols; ++u) {
      ASSERT_EQ(raw(v, u) != 0, scan.stack.mask(v, u) != 0);
      if (raw(v, u) == 0) continue;
      EXPECT_NEAR(raw(v, u) * scan.stack.depth_unit_m, static_cast<double>(scan.truth.depth(v, u)), 0.51e-4);
    }
  }
}

class EveryScene : public testing::TestWithParam<SceneKind> {};

TEST_P(EveryScene, FillsTheViewAndStaysWithinIt) {
  const SimulateOptions options = ideal_rig(GetParam());
  const Simulated scan = simulate_stack(options);
  const cv::Mat1b& mask = scan.stack.mask;
  EXPECT_GT(cv::countNonZero(mask), 0.15 * mask.rows * mask.cols);
  EXPECT_EQ(cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(mask.rows - 1)), 0);
  EXPECT_EQ(cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(mask.cols - 1)), 0);
}

TEST_P(EveryScene, HasUnitNormalsThatFaceTheRay) {
  const Simulated scan = simulate_stack(ideal_rig(GetParam()));
  const Camera& camera = scan.stack.color_camera;
  int away = 0, total = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (scan.stack.mask(v, u) == 0) continue;
      const cv::Vec3f n = scan.truth.normals(v, u);
      ASSERT_NEAR(cv::norm(n), 1.0, 1e-5);
      ++total;
      if (ray(camera, u, v).dot(Eigen::Vector3d(n[0], n[1], n[2])) > 0.05) ++away;
    }
  }
  EXPECT_LT(away, 0.01 * total);  // smooth normals may lean past the rim of a facet
}

/// Depth and normals tell the same surface: normals from depth by differences agree where it is smooth.
TEST_P(EveryScene, HasNormalsThatAgreeWithItsDepth) {
  SimulateOptions options = ideal_rig(GetParam());
  options.color_scale = 4;  // the objects' relief is finer than 64 x 48 pixels
  const Simulated scan = simulate_stack(options);
  const Camera& camera = scan.stack.color_camera;
  const auto point = [&](int u, int v) -> Eigen::Vector3d {
    return static_cast<double>(scan.truth.depth(v, u)) * ray(camera, u, v);
  };
  std::vector<double> cosines;
  for (int v = 1; v + 1 < camera.height; ++v) {
    for (int u = 1; u + 1 < camera.width; ++u) {
      const Eigen::Vector3d normal =
          (point(u, v + 1) - point(u, v - 1)).cross(point(u + 1, v) - point(u - 1, v));
      const cv::Vec3f n = scan.truth.normals(v, u);
      if (normal.allFinite()) cosines.push_back(normal.normalized().dot(Eigen::Vector3d(n[0], n[1], n[2])));
    }
  }
  ASSERT_GT(cosines.size(), 1000U);
  std::nth_element(cosines.begin(), cosines.begin() + static_cast<long>(cosines.size() / 4), cosines.end());
  EXPECT_GT(cosines[cosines.size() / 4], std::cos(6 * M_PI / 180));
}

INSTANTIATE_TEST_SUITE_P(Objects, EveryScene,
                         testing::Values(SceneKind::vase, SceneKind::coin, SceneKind::drape,
                                         SceneKind::sphere, SceneKind::plane));

TEST(Scene, ACoarseDepthGridSeesTheSamePlaceAsTheFineColourGrid) {
  SimulateOptions options = ideal_rig(SceneKind::sphere);
  options.color_scale = 2;
  const Simulated scan = simulate_stack(options);
  ASSERT_EQ(scan.truth.depth.size(), cv::Size(128, 96));
  const cv::Mat1w& raw = scan.stack.frames.front().depth;
  ASSERT_EQ(raw.size(), cv::Size(64, 48));
  for (int u = 20; u < 44;
       ++u) {  // away from the rim the block's mean depth is its centre's, up to curvature
    double mean = 0;
    for (int k = 0; k < 4; ++k)
      mean += static_cast<double>(scan.truth.depth(2 * 24 + k / 2, 2 * u + k % 2)) / 4;
    EXPECT_NEAR(raw(24, u) * scan.stack.depth_unit_m, mean, 2e-4);
  }
}

}  // namespace
}  // namespace rakelight
