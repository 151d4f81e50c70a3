// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (29)-(32), corrected: one step of the depth, given lamps and albedo.
//
// With lamps and albedo held, the images are ten numbers a pixel (refine/steps/photometric_tensor.h), and the step is that of
// the energy sum weight e(n) over the corners of all pixels:
//   Gauss-Newton:  dn = (I - n n') J / d  d(zeta_x, zeta_y)   (d n / d gradient, METHODS: "Eq. 13 and Alg. 3")
//   fixed point:   n = J' / d with d frozen                   (the paper)
#pragma once

#include "refine/grid_rows.h"
#include "refine/solver/depth_solver.h"
#include "refine/steps/normals.h"
#include "refine/steps/photometric_tensor.h"
#include "refine/steps/super_resolution.h"

namespace rakelight {

/// Four weights a pixel, one a corner; 0 for the corners it does not have.
class CornerWeights {
 public:
  explicit CornerWeights(size_t pixels = 0) : values_(pixels + kVectorPadding), pixels_(pixels) {}

  size_t size() const { return pixels_; }
  std::array<float, kCorners>& operator[](size_t pixel) { return values_[pixel]; }
  const std::array<float, kCorners>& operator[](size_t pixel) const { return values_[pixel]; }

 private:
  std::vector<std::array<float, kCorners>> values_;
  size_t pixels_;
};

/// Everything of a depth step that stays while the depth moves.
struct DepthProblem {
  const PixelGrid& grid;
  const CornerList& corners;
  const PhotometricTensors& tensors;
  const CornerWeights& corner_weight;  ///< see corner_weights
  const DepthPrior& prior;
  CurvatureWeights curvature = {};  ///< smoothness of zeta; empty: none
};

/// Weight of each corner: 1 / corners of the pixel (CornerList::weight), divided by sqrt(1 + e / (edge_weight median e)), e its energy at zeta,
/// so that gradients do not cross occlusions. The root makes a corner's say level off rather than vanish: without it, where
/// lamps miss a little everywhere, the surface tears along lines instead of bending.
CornerWeights corner_weights(const PixelGrid& grid, const CornerList& corners,
                             const PhotometricTensors& tensors, const Eigen::VectorXd& zeta,
                             double edge_weight);

/// sum over corners of weight e(n) + the prior's energy + that of the curvature.
double depth_energy(const DepthProblem& problem, const Eigen::VectorXd& zeta);

/// The system whose solution is the step: half the Hessian's approximation and minus half the gradient at zeta.
DepthSystem depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta,
                         Linearization linearization);

/// The same in the memory of an earlier system of this grid. @return the energy at zeta, as depth_energy has it
double fill_depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta,
                         Linearization linearization, DepthSystem& system);

struct DepthStepReport {
  bool solved = false;
  double energy_before = 0, energy_after = 0;
  int backtracks = 0;
};

/// Moves zeta by one step. The energy never rises when backtracking is on.
DepthStepReport depth_step(const DepthProblem& problem, const DepthOptions& options, DepthSolver& solver,
                           Eigen::VectorXd& zeta);

}  // namespace rakelight
