// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/mesh.h"

#include <algorithm>
#include <cmath>

#include "refine/output/images.h"
#include "refine/output/triangulate.h"

namespace rakelight {
namespace {

bool has_depth(const cv::Mat1f& depth, int y, int x) { return std::isfinite(depth(y, x)) && depth(y, x) > 0; }

cv::Vec3f back_project(const Camera& camera, int x, int y, double z) {
  return cv::Vec3d((x - camera.cx) * z / camera.fx, (y - camera.cy) * z / camera.fy, z);
}

}  // namespace

Mesh mesh_of(const RefineResult& result, int stride) {
  Mesh mesh;
  const cv::Mat3b colors = albedo_picture(result.albedo);
  cv::Mat1i index(result.depth.size(), -1);
  for (int y = 0; y < index.rows; y += stride) {
    for (int x = 0; x < index.cols; x += stride) {
      if (!has_depth(result.depth, y, x)) continue;
      index(y, x) = static_cast<int>(mesh.vertices.size());
      const double z = result.depth(y, x), z0 = result.initial_depth(y, x);
      const auto delta_mm = static_cast<float>((z - z0) * 1e3);
      mesh.vertices.push_back(
          {back_project(result.camera, x, y, z), result.normals(y, x), colors(y, x), delta_mm});
    }
  }
  mesh.triangles = triangulate(result.camera, result.depth, index, stride);
  return mesh;
}

int stride_for(const cv::Mat1f& depth, int vertices) {
  const double pixels = cv::countNonZero(depth == depth);
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / vertices))));
}

}  // namespace rakelight
