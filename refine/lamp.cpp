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
    for (int p = begin; p < end; ++p) {
      const cv::Point& pixel = grid.pixels[static_cast<size_t>(p)];
      const double z = std::exp(zeta[p]);
      points.col(p) = Eigen::Vector3d((pixel.x - camera.cx) / camera.fx * z, (pixel.y - camera.cy) / camera.fy * z, z)
                          .cast<float>();
    }
  });
  return points;
}

}  // namespace rakelight
