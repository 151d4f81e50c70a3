// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted second differences of a depth system's unknown along both axes,
//
//     x' C x = sum_p across_p (x_left - 2 x_p + x_right)^2 + down_p (x_up - 2 x_p + x_down)^2
//
// C reaches two pixels far, past the system's 9-point stencil, so it is kept as its weights and multiplied as it is.
#pragma once

#include <Eigen/SparseCore>

#include "refine/pixel_grid.h"

namespace rakelight {

struct CurvatureWeights {
  Eigen::VectorXd across,
      down;  ///< [pixel]; 0 where a neighbour is outside the mask. Both empty: no such term

  bool empty() const { return across.size() == 0; }
};

/// x' C x
double curvature_energy(const PixelGrid& grid, const CurvatureWeights& weights, const Eigen::VectorXd& x);

/// C x
Eigen::VectorXd curvature_product(const PixelGrid& grid, const CurvatureWeights& weights,
                                  const Eigen::VectorXd& x);

/// Lower triangle of C.
Eigen::SparseMatrix<double> curvature_lower_triangle(const PixelGrid& grid, const CurvatureWeights& weights);

}  // namespace rakelight
