// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A geometric multigrid V-cycle for 9-point stencils on a pixel rectangle: the preconditioner of the depth step.
//
// Vertex-centred coarsening (every second pixel), bilinear transfer, Galerkin coarse stencils, zebra line Gauss-Seidel
// along rows (even rows, then odd ones; the other way round after the coarse correction, so that the cycle is
// symmetric), an exact solve at the coarsest level. Pixels outside the mask are rows of zeros. Rows of one colour do
// not touch each other: they run in parallel, and the result does not depend on the number of threads. Both colours and the
// transfer to or from the coarser level are done in one go over a strip of rows, which stays in the cache.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "refine/solver/line_solver.h"

namespace rakelight {

/// Approximate inverse of a positive definite stencil.
class Multigrid {
 public:
  /// Builds the coarser stencils, in the memory of the last ones. @return false when the matrix is seen not to be positive
  /// definite.
  /// @param finest must stay until the last apply()
  bool setup(const StencilGrid& finest);

  /// How often each level is relaxed before and after its correction: 1, or more where the entries vary wildly.
  void set_sweeps(int sweeps) { sweeps_ = sweeps; }

  /// z = M r with M symmetric positive definite, close to inv(A). @param z of size() with zeros in its borders, or empty
  void apply(const Eigen::VectorXf& r, Eigen::VectorXf& z);

  /// The same, and Az = A z. @return z' A z and r' z
  Products apply(const Eigen::VectorXf& r, Eigen::VectorXf& z, Eigen::VectorXf& Az);

 private:
  struct Level {
    StencilGrid own;  ///< of the coarser levels
    LineSolver lines;
    Eigen::VectorXf x, r;  ///< of the coarser levels: correction and right-hand side
  };

  const StencilGrid& stencil(size_t level) const { return level == 0 ? *finest_ : levels_[level].own; }
  void shape_levels();
  bool factorize_coarsest();
  Products cycle(size_t level, const Eigen::VectorXf& r, Eigen::VectorXf& x, Eigen::VectorXf* Ax);
  void solve_coarsest(const Eigen::VectorXf& r, Eigen::VectorXf& x) const;

  int sweeps_ = 1;
  const StencilGrid* finest_ = nullptr;
  GridLayout shape_;  ///< that the levels are made for
  std::vector<Level> levels_;
  std::vector<Eigen::Index> coarsest_cells_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
};

}  // namespace rakelight
