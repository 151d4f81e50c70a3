// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric 9-point stencil on width x height pixels, zero outside the mask. Rows have a border of zeros that lets whole
// vectors be read and written (refine/kernels/stencil_kernels.h).
#pragma once

#include <Eigen/Core>

#include "refine/kernels/stencil_kernels.h"
#include "refine/pixel_blocks.h"

namespace rakelight {

struct StencilGrid {
  int width = 0, height = 0;
  Eigen::VectorXf diagonal;                            ///< entry (i, i); 0 outside the mask
  Eigen::VectorXf right, down, down_right, down_left;  ///< entry (i, neighbour in that direction)

  StencilGrid() = default;
  StencilGrid(int width_px, int height_px);

  Eigen::Index stride() const {
    return (width + kernels::kRowAlign - 1) / kernels::kRowAlign * kernels::kRowAlign + 2;
  }
  Eigen::Index at(int x, int y) const { return (y + 1) * stride() + x + 1; }

  /// Of vectors over the grid: with borders, and what a vector kernel may read past the last.
  Eigen::Index size() const { return stride() * (height + 2) + 4 * kernels::kRowAlign; }

  kernels::StencilRow row(int y) const;

  /// y = A x for vectors of size() whose borders are zeros. @return x' A x
  double multiply(const Eigen::VectorXf& x, Eigen::VectorXf& y) const;
};

/// Calls body(y) for rows first, first + step, ... of a grid, in parallel where that is worth it.
template <class Body>
void for_rows(const StencilGrid& grid, int first, int step, const Body& body) {
  constexpr Eigen::Index kWorthThreads = 16384;  // pixels; smaller grids run faster in one thread
  const int rows = (grid.height - first + step - 1) / step;
  const auto run = [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) body(first + k * step);
  };
  if (grid.size() < kWorthThreads)
    run({0, rows});
  else
    cv::parallel_for_(cv::Range(0, rows), run);
}

}  // namespace rakelight
