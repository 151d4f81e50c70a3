// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/lamp.h"

#include <cmath>

#include "refine/kernels/depth_kernels.h"
#include "refine/pixel_blocks.h"

namespace rakelight {

Eigen::Matrix3Xf surface_points(const PixelGrid& grid, const Eigen::VectorXd& zeta) {
  const Camera& camera = grid.camera;
  Eigen::Matrix3Xf points(3, grid.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(grid.runs.size())), [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) {
      const PixelRun& run = grid.runs[static_cast<size_t>(k)];
      const double origin = zeta[run.first];  // floats hold the rest: 1e-7 of the depth
      const double y = grid.pixels[static_cast<size_t>(run.first)].y - camera.cy;
      const kernels::RayRun rays{static_cast<float>((run.x - camera.cx) / camera.fx),
                                 static_cast<float>(y / camera.fy), static_cast<float>(1 / camera.fx),
                                 run.count};
      kernels::ray_points(rays, zeta.data() + run.first, origin, static_cast<float>(std::exp(origin)),
                          points.data() + 3 * std::ptrdiff_t{run.first});
    }
  });
  return points;
}

}  // namespace rakelight
