// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/lamp.h"

#include <cmath>

#include "refine/pixel_blocks.h"

namespace rakelight {

Eigen::Matrix3Xf surface_points(const PixelGrid& grid, const Eigen::VectorXd& zeta) {
  const Camera& camera = grid.camera;
  Eigen::Matrix3Xf points(3, grid.size());
  for_each_block(grid.size(), [&](int begin, int end) {
    const double origin = zeta[begin];  // floats hold the rest: 1e-7 of the depth
    const Eigen::ArrayXf rest = (zeta.segment(begin, end - begin).array() - origin).cast<float>();
    const Eigen::ArrayXf ratio = rest.exp();
    const auto scale = static_cast<float>(std::exp(origin));
    const auto fx = static_cast<float>(1 / camera.fx), fy = static_cast<float>(1 / camera.fy);
    for (int p = begin; p < end; ++p) {
      const cv::Point& pixel = grid.pixels[static_cast<size_t>(p)];
      const float z = scale * ratio[p - begin];
      points.col(p) << static_cast<float>(pixel.x - camera.cx) * fx * z,
          static_cast<float>(pixel.y - camera.cy) * fy * z, z;
    }
  });
  return points;
}

}  // namespace rakelight
