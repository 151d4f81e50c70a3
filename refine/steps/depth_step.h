// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (29)-(32), corrected: one step of the depth, given lamps and albedo.
//
// With lamps and albedo held, the photometric energy of a pixel is quadratic in its normal, whatever the number of images:
//
//     e(n) = n' G n - 2 h' n + e0,   G = sum w rho^2 l l',  h = sum w rho l (I - rho phi),  e0 = sum w (I - rho phi)^2
//
// so the images are read once, and the step works on ten numbers a pixel.
//   Gauss-Newton:  dn = (I - n n') J / d  d(zeta_x, zeta_y)   (d n / d gradient, METHODS: "Eq. 13 and Alg. 3")
//   fixed point:   n = J' / d with d frozen                   (the paper)
#pragma once

#include "refine/solver/depth_solver.h"
#include "refine/steps/normals.h"
#include "refine/steps/photometric_tensor.h"
#include "refine/steps/super_resolution.h"

namespace rakelight {

/// Everything of a depth step that stays while the depth moves.
struct DepthProblem {
  const PixelGrid& grid;
  const CornerList& corners;
  const PhotometricTensors& tensors;
  const std::vector<std::array<float, 4>>& corner_weight;  ///< see corner_weights
  const DepthPrior& prior;
  CurvatureWeights curvature = {};  ///< smoothness of zeta; empty: none
};

/// Weight of each corner: 1 / corners of the pixel, divided by sqrt(1 + e / (edge_weight median e)), e its energy at zeta,
/// so that gradients do not cross occlusions. The root makes a corner's say level off rather than vanish: without it, where
/// lamps miss a little everywhere, the surface tears along lines instead of bending.
std::vector<std::array<float, 4>> corner_weights(const PixelGrid& grid, const CornerList& corners,
                                                 const PhotometricTensors& tensors,
                                                 const Eigen::VectorXd& zeta, double edge_weight);

/// sum over corners of weight e(n) + the prior's energy + that of the curvature.
double depth_energy(const DepthProblem& problem, const Eigen::VectorXd& zeta);

/// The system whose solution is the step: half the Hessian's approximation and minus half the gradient at zeta.
DepthSystem depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta,
                         Linearization linearization);

struct DepthStepReport {
  bool solved = false;
  double energy_before = 0, energy_after = 0;
  int backtracks = 0;
};

/// Moves zeta by one step. The energy never rises when backtracking is on.
DepthStepReport depth_step(const DepthProblem& problem, const DepthOptions& options, DepthSolver& solver,
                           Eigen::VectorXd& zeta);

}  // namespace rakelight
