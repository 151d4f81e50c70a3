// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (33), (34): the sensor's reading of a depth pixel is the mean K Z of the s x s refined pixels it covers.
// With s = 1 this is the plain prior lambda_z |z - z0|^2.
#pragma once

#include <Eigen/Core>

#include "refine/kernels/prior_kernels.h"
#include "refine/pixel_grid.h"
#include "refine/solver/depth_solver.h"

namespace rakelight {

/// Pull of the sensor's depth on zeta = log z:
///   sum_cells weight (mean zeta over the cell - target)^2 + sum_pixels floor (zeta - start)^2
/// The floor keeps pixels that no reading covers from floating (they are unconstrained in the paper).
struct DepthPrior {
  DepthCells cells;
  Eigen::VectorXd cell_weight;  ///< lambda_z of each depth pixel, 0 where it has no reading
  Eigen::VectorXd cell_target;  ///< log depth
  Eigen::VectorXd start;        ///< [pixel] log depth
  double floor = 0.5;
};

/// Cells of the refined grid: pixel (u, v) belongs to depth pixel (u / scale, v / scale).
DepthCells make_cells(const PixelGrid& grid, int scale);

/// Depth pixel (column, row) of each cell.
std::vector<cv::Point> cell_positions(const PixelGrid& grid, const DepthCells& cells, int scale);

/// K zeta: the mean of zeta over each cell.
Eigen::VectorXd cell_means(const DepthCells& cells, const Eigen::VectorXd& zeta);

double prior_energy(const DepthPrior& prior, const Eigen::VectorXd& zeta);

/// The prior's energy and equations at zeta, run by run of a grid's pixels.
class PriorTerm {
 public:
  /// prior and zeta must outlive it.
  PriorTerm(const DepthPrior& prior, const Eigen::VectorXd& zeta);

  /// What belongs to no pixel: the energy of the cells where they are of several pixels.
  double shared_energy() const { return shared_energy_; }

  /// The other energy of pixels [first, first + count).
  double energy(int first, int count) const;

  /// Adds the half Hessian's diagonal (K' Lambda K lumped) and the negative half gradient of these pixels.
  /// @return their energy, as above
  double add(int first, int count, float* diagonal, float* rhs) const;

 private:
  kernels::PriorRun run(int first) const;

  const DepthPrior& prior_;
  const Eigen::VectorXd& zeta_;
  bool single_cells_;
  double shared_energy_ = 0;
  Eigen::VectorXd cell_pull_,
      cell_share_;  ///< of cells of several pixels: what each gets of the pull and of Lambda
};

/// Adds the prior's half Hessian and its negative half gradient at zeta.
void add_prior(const PixelGrid& grid, const DepthPrior& prior, const Eigen::VectorXd& zeta,
               DepthSystem& system);

}  // namespace rakelight
