// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "refine/output/images.h"

namespace rakelight {
namespace {

/// A face this many times as deep as it is wide is a jump between two surfaces, not a surface (84 degrees).
constexpr double kJumpSlope = 10.0;

bool has_depth(const cv::Mat1f& depth, int y, int x) { return std::isfinite(depth(y, x)) && depth(y, x) > 0; }

cv::Vec3f back_project(const Camera& camera, int x, int y, double z) {
  return cv::Vec3d((x - camera.cx) * z / camera.fx, (y - camera.cy) * z / camera.fy, z);
}

/// Adds the triangles between pixels of the depth grid.
class Triangulation {
 public:
  Triangulation(const RefineResult& result, int stride, const cv::Mat1i& vertex_index, Mesh& mesh)
      : depth_(result.depth),
        stride_(stride),
        focal_px_(std::min(result.camera.fx, result.camera.fy)),
        index_(vertex_index),
        mesh_(mesh) {}

  /// The square whose first corner is (x, y): two triangles, split along the diagonal with the smaller depth
  /// difference, or the one triangle that three corners allow.
  void add_square(int x, int y) {
    const cv::Point a(x, y), b(x + stride_, y), c(x, y + stride_), d(x + stride_, y + stride_);
    const bool along_ad =
        missing(b) || missing(c) || (!missing(a) && !missing(d) && step(a, d) <= step(b, c));
    if (along_ad) {
      add(a, c, d);
      add(a, d, b);
    } else {
      add(a, c, b);
      add(b, c, d);
    }
  }

 private:
  bool missing(const cv::Point& p) const { return index_(p) < 0; }
  double step(const cv::Point& p, const cv::Point& q) const {
    return std::abs(static_cast<double>(depth_(p)) - static_cast<double>(depth_(q)));
  }
  bool joined(const cv::Point& p, const cv::Point& q) const {
    const double pixel_m = static_cast<double>(std::min(depth_(p), depth_(q))) / focal_px_;
    return step(p, q) <= kJumpSlope * pixel_m * cv::norm(p - q);
  }
  void add(const cv::Point& p, const cv::Point& q, const cv::Point& r) {
    if (missing(p) || missing(q) || missing(r)) return;
    if (!joined(p, q) || !joined(q, r) || !joined(r, p)) return;
    mesh_.triangles.push_back({index_(p), index_(q), index_(r)});
  }

  const cv::Mat1f& depth_;
  int stride_;
  double focal_px_;
  const cv::Mat1i& index_;
  Mesh& mesh_;
};

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
  Triangulation triangulation(result, stride, index, mesh);
  for (int y = 0; y + stride < index.rows; y += stride) {
    for (int x = 0; x + stride < index.cols; x += stride) triangulation.add_square(x, y);
  }
  return mesh;
}

int stride_for(const cv::Mat1f& depth, int vertices) {
  const double pixels = cv::countNonZero(depth == depth);
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / vertices))));
}

}  // namespace rakelight
