// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/depth_normals.h"

#include <cmath>
#include <limits>

namespace rakelight {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Logarithm of depth, NaN where there is none: a difference with such a pixel is NaN, too.
cv::Mat1d log_depth(const cv::Mat1f& depth) {
  cv::Mat1d result(depth.size(), kNaN);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double z = depth(y, x);
      if (std::isfinite(z) && z > 0) result(y, x) = std::log(z);
    }
  }
  return result;
}

/// Difference towards the next pixel, from the last one at borders, 0 for a pixel that stands alone.
double slope(double last, double here, double next) {
  if (std::isfinite(next)) return next - here;
  if (std::isfinite(last)) return here - last;
  return 0;
}

}  // namespace

cv::Mat3d normals_from_depth(const Camera& camera, const cv::Mat1f& depth) {
  const cv::Mat1d zeta = log_depth(depth);
  const auto at = [&zeta](int y, int x) {
    return y >= 0 && x >= 0 && y < zeta.rows && x < zeta.cols ? zeta(y, x) : kNaN;
  };
  cv::Mat3d normals(depth.size(), cv::Vec3d::all(kNaN));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (!std::isfinite(zeta(y, x))) continue;
      const double p = slope(at(y, x - 1), zeta(y, x), at(y, x + 1));
      const double q = slope(at(y - 1, x), zeta(y, x), at(y + 1, x));
      const cv::Vec3d n(camera.fx * p, camera.fy * q,
                        -1 - (x - camera.cx) * p - (y - camera.cy) * q);  // Eq. (5)
      normals(y, x) = n / cv::norm(n);
    }
  }
  return normals;
}

cv::Mat3f normals_in(const cv::Rect& part, const Camera& camera, const cv::Mat1f& depth) {
  Camera here = camera;
  here.width = part.width;
  here.height = part.height;
  here.cx -= part.x;
  here.cy -= part.y;
  cv::Mat3f normals;
  normals_from_depth(here, depth(part)).convertTo(normals, CV_32F);
  return normals;
}

}  // namespace rakelight
