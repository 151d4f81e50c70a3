// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A depth system as a full matrix, for comparing with dense algebra.
#pragma once

#include <Eigen/Dense>

#include "refine/solver/depth_solver.h"
#include "refine/solver/placement.h"

namespace rakelight::test {

/// K: the mean over each cell, cells x pixels.
inline Eigen::MatrixXd dense_means(const DepthCells& cells) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(cells.size(), static_cast<Eigen::Index>(cells.cell_of.size()));
  for (int cell = 0; cell < cells.size(); ++cell)
    for (const int p : cells.of(cell)) K(cell, p) = 1.0 / static_cast<double>(cells.of(cell).size());
  return K;
}

/// S + K' Lambda K.
inline Eigen::MatrixXd dense_matrix(const PixelGrid& grid, const DepthCells& cells,
                                    const DepthSystem& system) {
  const Eigen::MatrixXd K = dense_means(cells);
  const Eigen::MatrixXd of_cells = K.transpose() * system.cell_weight.asDiagonal() * K;
  Eigen::MatrixXd A = of_cells;
  A.diagonal() -= of_cells.rowwise().sum();  // which the stencil has
  const Placement placement(grid);
  const auto add = [&](int p, int u, int v, float entry) {
    const auto value = static_cast<double>(entry);
    if (u < 0 || v < 0 || u >= grid.index.cols || v >= grid.index.rows || grid.index(v, u) < 0) return;
    A(p, grid.index(v, u)) += value;
    A(grid.index(v, u), p) += value;
  };
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    const Eigen::Index i = placement.place(p);
    A(p, p) += static_cast<double>(system.stencil.diagonal[i]);
    add(p, at.x + 1, at.y, system.stencil.right[i]);
    add(p, at.x, at.y + 1, system.stencil.down[i]);
    add(p, at.x + 1, at.y + 1, system.stencil.down_right[i]);
    add(p, at.x - 1, at.y + 1, system.stencil.down_left[i]);
  }
  return A;
}

/// The right-hand side, a number a pixel.
inline Eigen::VectorXd pixel_rhs(const PixelGrid& grid, const DepthSystem& system) {
  Eigen::VectorXd rhs;
  Placement(grid).gather(system.rhs, 1, rhs);
  return rhs;
}

/// About thirty pixels: a rectangle with a bite, a hole and a pixel that hangs by its side.
inline PixelGrid bitten_grid() {
  cv::Mat1b mask(7, 8, uchar{0});
  mask(cv::Rect(1, 1, 6, 5)).setTo(255);
  mask(1, 1) = mask(1, 2) = mask(3, 3) = 0;
  mask(6, 6) = 255;
  return make_pixel_grid({8, 7, 20.0, 22.0, 3.6, 2.9, {}}, mask);
}

}  // namespace rakelight::test
