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

/// Symmetric system (stencil + K' diag(cell_weight) K + C) x = rhs, C of second differences (refine/solver/curvature.h).
struct DepthSystem {
  std::vector<float> diagonal, right, down, down_right,
      down_left;                ///< entry (p, neighbour of p in that direction), 0 without one
  Eigen::VectorXd cell_weight;  ///< Lambda, a number a cell
  CurvatureWeights curvature;
  Eigen::VectorXd rhs;

  explicit DepthSystem(int pixels)
      : diagonal(static_cast<size_t>(pixels)),
        right(diagonal),
        down(diagonal),
        down_right(diagonal),
        down_left(diagonal),
        rhs(Eigen::VectorXd::Zero(pixels)) {}
};

class DepthSolver {
 public:
  virtual ~DepthSolver() = default;

  /// Solves the system. @return false when it is not positive definite; x is then untouched.
  virtual bool solve(DepthSystem system, Eigen::VectorXd& x) = 0;

  /// Solves the last system solved for another right-hand side. @return as solve.
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
