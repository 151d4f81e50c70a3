// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/triangulate.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rakelight {
namespace {

/// A face this many times as deep as it is wide is a jump between two surfaces, not a surface (84 degrees).
constexpr double kJumpSlope = 10.0;

/// Adds the triangles between pixels of the depth grid.
class Triangulation {
 public:
  Triangulation(const Camera& camera, const cv::Mat1f& depth, const cv::Mat1i& vertex_index, int stride)
      : depth_(depth), stride_(stride), focal_px_(std::min(camera.fx, camera.fy)), index_(vertex_index) {}

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

  void expect(std::size_t triangles) { triangles_.reserve(triangles); }
  std::vector<std::array<int, 3>> take() { return std::move(triangles_); }

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
    triangles_.push_back({index_(p), index_(q), index_(r)});
  }

  const cv::Mat1f& depth_;
  int stride_;
  double focal_px_;
  const cv::Mat1i& index_;
  std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

std::vector<std::array<int, 3>> triangulate(const Camera& camera, const cv::Mat1f& depth,
                                            const cv::Mat1i& vertex_index, int stride) {
  Triangulation triangulation(camera, depth, vertex_index, stride);
  triangulation.expect(2 * depth.total() / static_cast<std::size_t>(stride * stride));
  for (int y = 0; y + stride < depth.rows; y += stride) {
    for (int x = 0; x + stride < depth.cols; x += stride) triangulation.add_square(x, y);
  }
  return triangulation.take();
}

}  // namespace rakelight
