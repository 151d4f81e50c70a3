// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/stencil_grid.h"

namespace rakelight {

StencilGrid::StencilGrid(int width_px, int height_px) : GridLayout{width_px, height_px} {
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

kernels::EntryRow StencilGrid::entries(int x, int y) {
  const Eigen::Index i = at(x, y);
  return {diagonal.data() + i, right.data() + i, down.data() + i, down_right.data() + i,
          down_left.data() + i};
}

double StencilGrid::multiply(const Eigen::VectorXf& x, Eigen::VectorXf& y) const {
  if (y.size() != size()) y = Eigen::VectorXf::Zero(size());
  return sum_over_rows(
      *this, [&](int v) { return kernels::multiply_row(row(v), x.data() + at(0, v), y.data() + at(0, v)); });
}

Products ProductsOfRows::sum() const {
  Products sum;
  for (const kernels::RowProducts& row : rows_) {
    sum.xAx += static_cast<double>(row.xAx);
    sum.bx += static_cast<double>(row.bx);
  }
  return sum;
}

}  // namespace rakelight
