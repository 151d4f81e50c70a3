// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear depth systems of the paper: rows in the forward differences of one unknown a pixel,
//
//     min_x sum_rows (a . (x_u, x_v) - b)^2 + lambda_z |x - x0|^2 + |L x|^2                     Eq. (14), (24)
#pragma once

#include "refine/solver/sparse_cholesky.h"
#include "refine/steps/normals.h"
#include "refine/steps/smoothness.h"

namespace rakelight {

/// a . gradient of x at the pixel = b.
struct GradientRow {
  int pixel = 0;
  Eigen::Vector2d a;
  double b = 0;
};

/// One depth system; corners are those of the forward stencil (one a pixel), pixels without a corner have no row.
struct GradientProblem {
  const PixelGrid& grid;
  const CornerList& corners;
  std::vector<GradientRow> rows;
  double prior_weight = 0;  ///< lambda_z
  Eigen::VectorXd x0;
  const Smoothness& smoothness;
};

/// Forward differences of x at a pixel, zero where it has no corner.
Eigen::Vector2d forward_gradient(const PixelGrid& grid, const CornerList& corners, int p,
                                 const Eigen::VectorXd& x);

/// Normal equations: lower triangle and right-hand side.
Eigen::SparseMatrix<double> normal_matrix(const GradientProblem& problem, Eigen::VectorXd& rhs);

/// The minimiser. @return false when the system is singular; x is then untouched.
bool solve_gradient_rows(const GradientProblem& problem, SparseCholesky& solver, Eigen::VectorXd& x);

/// The energy above at x.
double gradient_energy(const GradientProblem& problem, const Eigen::VectorXd& x);

}  // namespace rakelight
