// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/coarse_scene.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr int kCellsWide = 80;
constexpr double kSmoothing_cells =
    1.2;                        // depth noise is correlated over a few pixels: it survives the mean of a cell
constexpr float kJump = 0.02F;  // of the depth from cell to cell: an edge of the object
const float kNan = std::numeric_limits<float>::quiet_NaN();

/// Mean of the readings of all frames in each cell, raw units; 0: fewer than half have one.
cv::Mat1f mean_depth(const std::vector<cv::Mat1w>& depths, int cell, cv::Size size) {
  cv::Mat1f sum(size, 0.0F), count(size, 0.0F);
  for (const cv::Mat1w& depth : depths) {
    for (int y = 0; y < size.height * cell; ++y) {
      for (int x = 0; x < size.width * cell; ++x) {
        if (depth(y, x) == 0) continue;
        sum(y / cell, x / cell) += static_cast<float>(depth(y, x));
        count(y / cell, x / cell) += 1;
      }
    }
  }
  const float half = 0.5F * static_cast<float>(cell * cell) * static_cast<float>(depths.size());
  cv::Mat1f mean(size, 0.0F);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      if (count(y, x) >= half) mean(y, x) = sum(y, x) / count(y, x);
    }
  }
  return mean;
}

/// Gaussian mean over the neighbours that lie on the same surface.
cv::Mat1f smoothed(const cv::Mat1f& depth) {
  cv::Mat1f result(depth.size(), 0.0F);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float here = depth(y, x);
      double sum = 0, weights = 0;
      for (int v = std::max(0, y - 2); v <= std::min(depth.rows - 1, y + 2); ++v) {
        for (int u = std::max(0, x - 2); u <= std::min(depth.cols - 1, x + 2); ++u) {
          if (depth(v, u) == 0 || std::abs(depth(v, u) - here) > 2 * kJump * here) continue;
          const double r2 = (u - x) * (u - x) + (v - y) * (v - y);
          const double weight = std::exp(-r2 / (2 * kSmoothing_cells * kSmoothing_cells));
          sum += weight * static_cast<double>(depth(v, u));
          weights += weight;
        }
      }
      if (here != 0) result(y, x) = static_cast<float>(sum / weights);
    }
  }
  return result;
}

Eigen::Vector3d point_of(const LightStack& stack, const CoarseScene& scene, int x, int y, double z) {
  const Camera& camera = stack.depth_camera;
  const double u = (x + 0.5) * scene.cell - 0.5, v = (y + 0.5) * scene.cell - 0.5;
  const Eigen::Vector4d point((u - camera.cx) / camera.fx * z, (v - camera.cy) / camera.fy * z, z, 1);
  return (stack.T_color_depth * point).head<3>();
}

void fill_normals(CoarseScene& scene) {
  for (int y = 1; y + 1 < scene.size.height; ++y) {
    for (int x = 1; x + 1 < scene.size.width; ++x) {
      const cv::Vec3f across = scene.points(y, x + 1) - scene.points(y, x - 1);
      const cv::Vec3f down = scene.points(y + 1, x) - scene.points(y - 1, x);
      const cv::Vec3f normal = down.cross(across);  // x right, y down: this faces the camera
      const float z = scene.points(y, x)[2];
      const bool smooth = std::abs(across[2]) < 4 * kJump * z && std::abs(down[2]) < 4 * kJump * z;
      const double length = cv::norm(normal);
      if (smooth && length > 0) scene.normals(y, x) = normal / length;
    }
  }
}

/// The image shrunk to about the cells' size.
cv::Mat shrunk(const CoarseScene& scene, const cv::Mat& image) {
  cv::Mat small;
  cv::resize(image, small, scene.size, 0, 0, cv::INTER_AREA);
  return small;
}

/// Row and column of a shrunk image where a cell is seen, or nothing.
std::optional<cv::Point> cell_in(const CoarseScene& scene, int x, int y) {
  const cv::Vec2f uv = scene.color_uv(y, x);
  if (std::isnan(uv[0])) return std::nullopt;
  return cv::Point(std::min(int(uv[0] * float(scene.size.width)), scene.size.width - 1),
                   std::min(int(uv[1] * float(scene.size.height)), scene.size.height - 1));
}

}  // namespace

CoarseScene coarse_scene(const LightStack& stack, const std::vector<cv::Mat1w>& depths) {
  CoarseScene scene;
  scene.cell = std::max(1, stack.depth_camera.width / kCellsWide);
  scene.size = stack.depth_camera.size() / scene.cell;
  scene.points = cv::Mat3f(scene.size, cv::Vec3f(kNan, kNan, kNan));
  scene.normals = scene.points.clone();
  scene.color_uv = cv::Mat2f(scene.size, cv::Vec2f(kNan, kNan));
  const cv::Mat1f depth = smoothed(mean_depth(depths, scene.cell, scene.size));
  const Camera& color = stack.color_camera;
  for (int y = 0; y < scene.size.height; ++y) {
    for (int x = 0; x < scene.size.width; ++x) {
      if (depth(y, x) == 0) continue;
      const Eigen::Vector3d p =
          point_of(stack, scene, x, y, static_cast<double>(depth(y, x)) * stack.depth_unit_m);
      if (!(p.z() > 0)) continue;
      scene.points(y, x) = {float(p.x()), float(p.y()), float(p.z())};
      const double u = (color.fx * p.x() / p.z() + color.cx + 0.5) / color.width;
      const double v = (color.fy * p.y() / p.z() + color.cy + 0.5) / color.height;
      if (u >= 0 && u < 1 && v >= 0 && v < 1) scene.color_uv(y, x) = {float(u), float(v)};
    }
  }
  fill_normals(scene);
  return scene;
}

cv::Mat3f at_cells(const CoarseScene& scene, const cv::Mat& color, const ColorResponse& response) {
  cv::Mat3f small, cells(scene.size, cv::Vec3f(0, 0, 0));
  shrunk(scene, color).convertTo(small, CV_32F, color.depth() == CV_16U ? 1.0 / 65535 : 1.0 / 255);
  for (int y = 0; y < scene.size.height; ++y) {
    for (int x = 0; x < scene.size.width; ++x) {
      const auto seen = cell_in(scene, x, y);
      if (!seen) continue;
      for (int c = 0; c < 3; ++c)
        cells(y, x)[c] = static_cast<float>(decode(response, static_cast<double>(small(*seen)[c])));
    }
  }
  return cells;
}

cv::Mat1f saturated_cells(const CoarseScene& scene, const cv::Mat& color) {
  Frame frame;
  frame.color = color;
  cv::Mat1f small, cells(scene.size, 0.0F);
  shrunk(scene, saturated(frame)).convertTo(small, CV_32F, 1.0 / 255);
  for (int y = 0; y < scene.size.height; ++y) {
    for (int x = 0; x < scene.size.width; ++x) {
      if (const auto seen = cell_in(scene, x, y)) cells(y, x) = small(*seen);
    }
  }
  return cells;
}

}  // namespace rakelight
