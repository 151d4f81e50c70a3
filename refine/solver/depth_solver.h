// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The linear system of a depth step and what solves it.
//
// The photometric rows at a pixel share its differences, so A'A is a 9-point stencil on the mask; the sensor's depth
// adds K' Lambda K with K the mean over the s x s block of a depth pixel (Eq. 34), and a weak diagonal.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "refine/pixel_grid.h"
#include "refine/solver/curvature.h"
#include "refine/solver/stencil_grid.h"

namespace rakelight {

/// Which refined pixels the reading of a depth pixel is the mean of.
struct DepthCells {
  /// Pixels of one cell, at most s x s.
  struct Pixels {
    const int *first, *last;
    const int* begin() const { return first; }
    const int* end() const { return last; }
    size_t size() const { return static_cast<size_t>(last - first); }
  };

  std::vector<int> cell_of;   ///< [pixel]: number of its cell
  std::vector<int> pixels;    ///< cell by cell
  std::vector<int> first{0};  ///< [cell]: where its pixels begin; one more at the end

  int size() const { return static_cast<int>(first.size()) - 1; }
  Pixels of(int cell) const {
    const auto i = static_cast<size_t>(cell);
    return {pixels.data() + first[i], pixels.data() + first[i + 1]};
  }
};

/// Symmetric system (S + K' diag(cell_weight) K + C) x = rhs, C of second differences (refine/solver/curvature.h).
struct DepthSystem {
  StencilGrid stencil;  ///< S, and on the diagonal the row sums of K' diag(cell_weight) K (its lumped form)
  Eigen::VectorXd cell_weight;  ///< Lambda, a number a cell
  CurvatureWeights curvature;
  Eigen::VectorXf rhs;  ///< laid out as the stencil (refine/solver/placement.h), 0 outside the mask

  /// Zeros.
  explicit DepthSystem(const PixelGrid& grid);
};

/// Lambda of a system that has none: sets cell_weight and adds the lumped form to the diagonal.
void add_cell_weight(const PixelGrid& grid, const DepthCells& cells, const Eigen::VectorXd& cell_weight,
                     DepthSystem& system);

/// C of a system that has none, and its negative half gradient at zeta.
void add_curvature(const PixelGrid& grid, const CurvatureWeights& weights, const Eigen::VectorXd& zeta,
                   DepthSystem& system);

class DepthSolver {
 public:
  virtual ~DepthSolver() = default;

  /// A system to be filled in, in the memory of the last one, which then cannot be solved again. Zeros outside the mask;
  /// all else may be what it was.
  virtual DepthSystem reuse_system() = 0;

  /// Solves the system. @return false when it is not positive definite; x is then untouched.
  virtual bool solve(DepthSystem system, Eigen::VectorXd& x) = 0;

  /// Solves the last system solved for another right-hand side, a number a pixel. @return as solve.
  virtual bool solve_again(const Eigen::VectorXd& rhs, Eigen::VectorXd& x) = 0;
};

/// The exact solver: CHOLMOD, symbolic factorisation kept. The grid and cells must outlive it.
std::unique_ptr<DepthSolver> make_cholesky_depth_solver(const PixelGrid& grid, const DepthCells& cells);

/// Conjugate gradients with a multigrid preconditioner (refine/solver/multigrid.h): time and memory linear in the pixels.
/// A system it does not converge on goes to the exact solver.
/// @param tolerance of the residual in the preconditioner's norm, relative to the right-hand side's
std::unique_ptr<DepthSolver> make_multigrid_depth_solver(const PixelGrid& grid, const DepthCells& cells,
                                                         double tolerance = 1e-4);

}  // namespace rakelight
