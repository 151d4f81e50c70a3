// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A geometric multigrid V-cycle for 9-point stencils on a pixel rectangle: the preconditioner of the depth step.
//
// Vertex-centred coarsening (every second pixel), bilinear transfer, Galerkin coarse stencils, zebra line Gauss-Seidel
// along rows (even rows, then odd ones; the other way round after the coarse correction, so that the cycle is
// symmetric), an exact solve at the coarsest level. Pixels outside the mask are rows of zeros. Rows of one colour do
// not touch each other: they run in parallel, and the result does not depend on the number of threads.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace rakelight {

/// Symmetric 9-point stencil on width x height pixels with a border of zeros one pixel wide.
struct StencilGrid {
  int width = 0, height = 0;
  Eigen::VectorXf diagonal;                            ///< entry (i, i); 0 outside the mask
  Eigen::VectorXf right, down, down_right, down_left;  ///< entry (i, neighbour in that direction)

  StencilGrid() = default;
  StencilGrid(int width_px, int height_px);

  Eigen::Index stride() const { return width + 2; }
  Eigen::Index size() const { return stride() * (height + 2); }
  Eigen::Index at(int x, int y) const { return (y + 1) * stride() + x + 1; }

  /// y = A x for vectors of size().
  void multiply(const Eigen::VectorXf& x, Eigen::VectorXf& y) const;
};

/// Approximate inverse of a positive definite stencil.
class Multigrid {
 public:
  /// Builds the coarser stencils. @return false when the matrix is seen not to be positive definite.
  bool setup(StencilGrid finest);

  /// z = M r with M symmetric positive definite, close to inv(A).
  void apply(const Eigen::VectorXf& r, Eigen::VectorXf& z);

  const StencilGrid& finest() const { return levels_.front().A; }

 private:
  struct Level {
    StencilGrid A;
    Eigen::VectorXf inverse_pivot, multiplier;  ///< of each row's tridiagonal part, factorised L D L'
    Eigen::VectorXf x, r, residual;
  };

  static bool factorize_rows(Level& level);
  bool factorize_coarsest();
  void cycle(size_t level);
  void solve_coarsest();

  std::vector<Level> levels_;
  std::vector<Eigen::Index> coarsest_cells_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
};

}  // namespace rakelight
