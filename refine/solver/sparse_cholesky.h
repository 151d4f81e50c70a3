// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CHOLMOD behind a small class that keeps the symbolic factorisation while the pattern stays the same.
#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace rakelight {

class SparseCholesky {
 public:
  using Matrix = Eigen::SparseMatrix<double>;  ///< column-major; only the lower triangle is read

  SparseCholesky();
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// Factorises A = L L'. The symbolic part is redone only when the size or the number of entries changes, so a caller
  /// keeps one object a pattern. @return false when A is not numerically positive definite (or memory ran out).
  bool factorize(const Matrix& lower);

  /// Solves A x = b. Needs a successful factorize.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Rough reciprocal condition number of A from the factor's diagonal, 0 when singular.
  double reciprocal_condition() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rakelight
