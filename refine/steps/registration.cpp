// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

namespace rakelight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool same_view(const Camera& a, const Camera& b) {
  constexpr double kPixel = 0.05;  // a twentieth of a pixel does not matter
  return a.size() == b.size() && a.distortion.empty() && b.distortion.empty() &&
         std::abs(a.cx - b.cx) < kPixel && std::abs(a.cy - b.cy) < kPixel &&
         std::abs(a.fx / b.fx - 1) < 1e-4 && std::abs(a.fy / b.fy - 1) < 1e-4;
}

/// Rays of the depth camera's pixels, (x/z, y/z), distortion removed.
std::vector<cv::Point2d> undistorted_rays(const Camera& camera) {
  std::vector<cv::Point2d> pixels;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) pixels.emplace_back(u, v);
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(pixels, rays, K, camera.distortion);
  return rays;
}

cv::Mat1f project_depth(const LightStack& stack, const cv::Mat1w& raw, const Camera& target) {
  cv::Mat1f depth(target.size(), kNaN);
  const std::vector<cv::Point2d> rays = undistorted_rays(stack.depth_camera);
  const Eigen::Matrix3d R = stack.T_color_depth.topLeftCorner<3, 3>();
  const Eigen::Vector3d t = stack.T_color_depth.topRightCorner<3, 1>();
  for (int v = 0; v < raw.rows; ++v) {
    for (int u = 0; u < raw.cols; ++u) {
      if (raw(v, u) == 0) continue;
      const cv::Point2d& ray =
          rays[static_cast<size_t>(v) * static_cast<size_t>(raw.cols) + static_cast<size_t>(u)];
      const Eigen::Vector3d p = R * (Eigen::Vector3d(ray.x, ray.y, 1) * (raw(v, u) * stack.depth_unit_m)) + t;
      if (p.z() <= 0) continue;
      const int x = static_cast<int>(std::lround(target.fx * p.x() / p.z() + target.cx));
      const int y = static_cast<int>(std::lround(target.fy * p.y() / p.z() + target.cy));
      if (x < 0 || y < 0 || x >= target.width || y >= target.height) continue;
      float& z = depth(y, x);
      if (std::isnan(z) || p.z() < static_cast<double>(z)) z = static_cast<float>(p.z());
    }
  }
  return depth;
}

}  // namespace

int color_to_depth_ratio(const LightStack& stack) {
  // Pixels an angle, not image sizes: the two cameras may see different fields of view.
  const double ratio = stack.color_camera.fx / stack.depth_camera.fx;
  return std::clamp(static_cast<int>(std::lround(ratio)), 1, 4);
}

Camera registered_depth_camera(const LightStack& stack) {
  Camera camera = binned(stack.color_camera, color_to_depth_ratio(stack));
  camera.distortion.clear();
  return camera;
}

cv::Mat1f registered_depth(const LightStack& stack, const Frame& frame) {
  const Camera target = registered_depth_camera(stack);
  const bool registered = stack.T_color_depth.isIdentity(1e-9) && same_view(stack.depth_camera, target) &&
                          stack.color_camera.distortion.empty();
  if (!registered) return project_depth(stack, frame.depth, target);
  cv::Mat1f depth(frame.depth.size(), kNaN);
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      if (frame.depth(v, u) != 0) depth(v, u) = static_cast<float>(frame.depth(v, u) * stack.depth_unit_m);
  return depth;
}

}  // namespace rakelight
