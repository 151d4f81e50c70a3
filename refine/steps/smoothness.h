// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smoothness term of the paper's linear depth systems (refine/steps/gradient_rows.h).
#pragma once

#include <Eigen/SparseCore>

namespace rakelight {

/// A quadratic smoothness term with its matrix made once.
class Smoothness {
 public:
  /// @param laplacian L without its weight  @param weight lambda: the term is lambda |laplacian zeta|^2
  Smoothness(const Eigen::SparseMatrix<double>& laplacian, double weight)
      : matrix_(weight * (Eigen::SparseMatrix<double>(laplacian.transpose()) * laplacian)) {}

  double energy(const Eigen::VectorXd& zeta) const { return zeta.dot(matrix_ * zeta); }
  const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }

 private:
  Eigen::SparseMatrix<double> matrix_;
};

}  // namespace rakelight
