// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tridiagonal systems along the rows of a stencil, factorised L D L'.
#pragma once

#include "refine/solver/stencil_grid.h"

namespace rakelight {

class LineSolver {
 public:
  /// Each step of a row waits for the one before it; several rows side by side fill the time.
  static constexpr int kRowsAtOnce = 4;

  /// @return false when a row is seen not to be positive definite
  bool factorize(const StencilGrid& A);

  /// x = inv(T_y) x in the rows first, first + step, ..., kRowsAtOnce of them, or as many as the grid has.
  void solve(const StencilGrid& A, int first, int step, Eigen::VectorXf& x) const;

 private:
  Eigen::VectorXf inverse_pivot_, multiplier_;
};

}  // namespace rakelight
