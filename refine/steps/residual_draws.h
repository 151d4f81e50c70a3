// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the depth step's right-hand side becomes when the data's residuals are multiplied by random numbers
// (refine/steps/uncertainty.h), some draws at a time: one reading of the images serves them all.
#pragma once

#include "refine/kernels/residual_sums.h"
#include "refine/observations.h"
#include "refine/steps/depth_step.h"
#include "refine/surface_state.h"

namespace rakelight {

constexpr int kDrawsAtATime = kernels::kDraws;
using DrawFactors = Eigen::Matrix<float, Eigen::Dynamic, kDrawsAtATime>;                   ///< [image, draw]
using DrawnPulls = Eigen::Matrix<float, 3, kDrawsAtATime>;                                 ///< [, draw]
using DrawnSides = Eigen::Matrix<double, Eigen::Dynamic, kDrawsAtATime, Eigen::RowMajor>;  ///< [pixel, draw]

/// For each pixel and draw the change of h - G n (PhotometricTensor) a unit of t when image i becomes I + t factor_i r,
/// r = I - rho S, the albedo following: sum_i factor_i w rho l r + sum_i w l (r - rho S) drho,
/// drho = sum_i factor_i w S r / sum_i w S^2.
std::vector<DrawnPulls> pulls_of_scaled_residuals(const Observations& images, const SurfaceState& state,
                                                  const DrawFactors& factors);

/// Change of the depth step's right-hand side (Gauss-Newton at zeta) that goes with these changes of h.
DrawnSides right_hand_sides(const DepthProblem& depth, const Eigen::VectorXd& zeta,
                            const std::vector<DrawnPulls>& pulls);

}  // namespace rakelight
