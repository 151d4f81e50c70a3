// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/grid_rows.h"

namespace rakelight {

ZetaImage::ZetaImage(const PixelGrid& grid, const Eigen::VectorXd& zeta)
    : grid_(grid),
      stride_(grid.box.width + 2),
      values_(static_cast<size_t>(stride_ * (grid.box.height + 2)) + kVectorPadding, 0.0f) {
  if (zeta.size() == 0) return;
  const double origin = zeta[zeta.size() / 2];
  for_each_run(grid, [&](int y, const PixelRun& run) {
    float* to = values_.data() + (y + 1) * stride_ + 1 + run.x - grid_.box.x;
    for (int k = 0; k < run.count; ++k) to[k] = static_cast<float>(zeta[run.first + k] - origin);
  });
}

kernels::CornerRun ZetaImage::run(const CornerList& corners, int y, const PixelRun& run) const {
  const Camera& camera = grid_.camera;
  const float* here = values_.data() + (y + 1) * stride_ + 1 + run.x - grid_.box.x;
  return {here - stride_,
          here,
          here + stride_,
          corners.present.data() + run.first,
          static_cast<float>(camera.fx),
          static_cast<float>(camera.fy),
          static_cast<float>(run.x - camera.cx),
          static_cast<float>(grid_.box.y + y - camera.cy),
          run.count};
}

}  // namespace rakelight
