// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface.h"

#include <algorithm>
#include <cmath>
#include <future>

#include "refine/depth_normals.h"
#include "refine/output/mesh.h"
#include "refine/output/triangulate.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// Share of the points left out of the bounds at each end of each axis.
constexpr double kStray = 0.002;

bool is_depth(float z) { return std::isfinite(z) && z > 0; }

cv::Vec3f back_project(const Camera& camera, const cv::Point& pixel, double z) {
  return cv::Vec3d((pixel.x - camera.cx) * z / camera.fx, (pixel.y - camera.cy) * z / camera.fy, z);
}

Box bounds_of(const std::vector<cv::Vec3f>& positions) {
  Box box;
  std::vector<float> values(positions.size());
  const auto stray = static_cast<std::ptrdiff_t>(kStray * static_cast<double>(positions.size()));
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(positions.begin(), positions.end(), values.begin(),
                   [axis](const cv::Vec3f& p) { return p[axis]; });
    const auto low = values.begin() + stray, high = values.end() - 1 - stray;
    std::nth_element(values.begin(), low, values.end());
    box.low[axis] = *low;
    std::nth_element(low, high, values.end());
    box.high[axis] = *high;
  }
  return box;
}

cv::Mat3f normals_of(const Layer& layer) {
  if (!layer.normals.empty()) return layer.normals;
  cv::Mat3f normals;
  normals_from_depth(layer.camera, layer.depth).convertTo(normals, CV_32F);
  return normals;
}

}  // namespace

void check_point_count(std::size_t points, const std::string& subject) {
  if (points == 0) {
    throw InputError(subject, "has no surface to show: not one pixel has depth",
                     "check the mask and the sensor's range, or name another layer");
  }
  if (points <= kMostPoints) return;
  throw InputError(subject,
                   "has " + std::to_string(points) + " points, more than the " + std::to_string(kMostPoints) +
                       " that can be drawn",
                   "refine with a smaller --scale or crop it with a mask");
}

Surface surface_of(const Layer& layer, const std::string& subject) {
  const auto points =
      static_cast<std::size_t>(std::count_if(layer.depth.begin(), layer.depth.end(), is_depth));
  check_point_count(points, subject);
  Surface surface;
  surface.positions.reserve(points);
  surface.normals.reserve(points);
  surface.pixels.reserve(points);
  const cv::Mat3f normals = normals_of(layer);
  cv::Mat1i index(layer.depth.size(), -1);
  for (int y = 0; y < index.rows; ++y) {
    for (int x = 0; x < index.cols; ++x) {
      const float z = layer.depth(y, x);
      if (!is_depth(z)) continue;
      index(y, x) = static_cast<int>(surface.positions.size());
      surface.positions.push_back(back_project(layer.camera, {x, y}, static_cast<double>(z)));
      surface.normals.push_back(normals(y, x));
      surface.pixels.emplace_back(x, y);
    }
  }
  auto coarse = std::async(std::launch::async, [&] {
    const int stride = stride_for(layer.depth, kCoarsePoints);
    surface.bounds = bounds_of(surface.positions);
    if (stride > 1) surface.coarse_triangles = triangulate(layer.camera, layer.depth, index, stride);
  });
  surface.triangles = triangulate(layer.camera, layer.depth, index);
  coarse.get();
  return surface;
}

}  // namespace rakelight
