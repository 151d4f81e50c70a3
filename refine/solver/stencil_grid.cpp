// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/stencil_grid.h"

#include <numeric>

namespace rakelight {

StencilGrid::StencilGrid(int width_px, int height_px) : width(width_px), height(height_px) {
  for (Eigen::VectorXf* part : {&diagonal, &right, &down, &down_right, &down_left})
    *part = Eigen::VectorXf::Zero(size());
}

kernels::StencilRow StencilGrid::row(int y) const {
  const Eigen::Index i = at(0, y);
  return {diagonal.data() + i,
          right.data() + i,
          down.data() + i,
          down_right.data() + i,
          down_left.data() + i,
          stride(),
          width};
}

double StencilGrid::multiply(const Eigen::VectorXf& x, Eigen::VectorXf& y) const {
  if (y.size() != size()) y = Eigen::VectorXf::Zero(size());
  std::vector<float> dots(static_cast<size_t>(height));
  for_rows(*this, 0, 1, [&](int v) {
    dots[static_cast<size_t>(v)] = kernels::multiply_row(row(v), x.data() + at(0, v), y.data() + at(0, v));
  });
  return std::accumulate(dots.begin(), dots.end(), 0.0);
}

}  // namespace rakelight
