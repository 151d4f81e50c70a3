// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A depth step whose energy has a smoothness term besides shading and sensor (Eq. 12):
//
//     E(zeta) = depth_energy(zeta) + |L zeta|^2,   L a weighted Laplacian
//
// L'L reaches two pixels far, so the system has 13 and more entries a row instead of the nine of DepthSystem.
#pragma once

#include "refine/solver/sparse_cholesky.h"
#include "refine/steps/depth_step.h"

namespace rakelight {

/// A quadratic smoothness term with its matrix made once.
class Smoothness {
 public:
  /// @param laplacian L without its weight  @param weight lambda: the term is lambda |laplacian zeta|^2
  Smoothness(const Eigen::SparseMatrix<double>& laplacian, double weight);

  /// @param matrix symmetric and positive semi-definite: the term is zeta' matrix zeta
  explicit Smoothness(Eigen::SparseMatrix<double> matrix);

  double energy(const Eigen::VectorXd& zeta) const { return zeta.dot(matrix_ * zeta); }
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  Eigen::SparseMatrix<double> matrix_;
};

/// Lower triangle of (depth system + smoothness).
Eigen::SparseMatrix<double> lower_triangle(const PixelGrid& grid, const DepthCells& cells,
                                           const DepthSystem& system, const Smoothness& smoothness);

/// As depth_step, with the smoothness term. The energy never rises when backtracking is on.
DepthStepReport smooth_depth_step(const DepthProblem& problem, const Smoothness& smoothness,
                                  const DepthOptions& options, SparseCholesky& solver, Eigen::VectorXd& zeta);

}  // namespace rakelight
