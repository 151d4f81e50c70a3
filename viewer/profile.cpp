// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rakelight {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector2d pixel_of(const Camera& camera, const Eigen::Vector3d& p) {
  return {camera.fx * p.x() / p.z() + camera.cx, camera.fy * p.y() / p.z() + camera.cy};
}

Eigen::Vector3d back_project(const Camera& camera, const Eigen::Vector2d& pixel, double z) {
  return {(pixel.x() - camera.cx) * z / camera.fx, (pixel.y() - camera.cy) * z / camera.fy, z};
}

/// Bilinear; NaN unless all four pixels around have depth.
double depth_at(const cv::Mat1f& depth, const Eigen::Vector2d& pixel) {
  const double x = std::clamp(pixel.x(), 0.0, depth.cols - 1.0),
               y = std::clamp(pixel.y(), 0.0, depth.rows - 1.0);
  const int x0 = std::min(static_cast<int>(x), depth.cols - 2),
            y0 = std::min(static_cast<int>(y), depth.rows - 2);
  const double u = x - x0, v = y - y0;
  const auto at = [&](int column, int row) { return static_cast<double>(depth(row, column)); };
  return (1 - v) * ((1 - u) * at(x0, y0) + u * at(x0 + 1, y0)) +
         v * ((1 - u) * at(x0, y0 + 1) + u * at(x0 + 1, y0 + 1));
}

}  // namespace

std::vector<ProfilePoint> profile_of(const Layer& layer, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (layer.depth.cols < 2 || layer.depth.rows < 2 || (b - a).norm() == 0) return {};
  const Eigen::Vector2d first = pixel_of(layer.camera, a), last = pixel_of(layer.camera, b);
  const Eigen::Vector3d along = (b - a).normalized();
  const Eigen::Vector3d to_camera = -(a + b).normalized();
  const Eigen::Vector3d up = (to_camera - to_camera.dot(along) * along).normalized();
  const int steps = std::max(1, static_cast<int>(std::lround((last - first).norm())));
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Eigen::Vector2d pixel = first + share * (last - first);
    const double z = depth_at(layer.depth, pixel);
    if (!std::isfinite(z) || z <= 0) {
      profile.push_back({1000 * share * (b - a).norm(), kNaN});
      continue;
    }
    const Eigen::Vector3d offset = back_project(layer.camera, pixel, z) - a;
    profile.push_back({1000 * offset.dot(along), 1000 * offset.dot(up)});
  }
  return profile;
}

}  // namespace rakelight
