// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far each pixel's depth and normal can be trusted.
//
// Depth: near its minimum the energy is delta' H delta, so depth errors are normal with covariance s^2 inv(H), s^2 the
// variance of a residual. The diagonal of inv(H) is not computed: samples L'^-1 xi of that distribution are cheap once
// H = L L' is there, and their spread, smoothed over neighbours, is what is wanted.
//
// Normals: what highlights, shadows and a wrong lamp do to them differs from lamp to lamp. So the last step is taken
// again without each quarter of the images (a grouped jackknife), and the normals' spread is the error that residuals,
// which know nothing of their own correlation, cannot show.
#pragma once

#include "refine/pixel_grid.h"
#include "refine/solver/depth_solver.h"
#include "refine/steps/depth_step.h"
#include "refine/steps/normals.h"

namespace rakelight {

/// One standard deviation a pixel.
struct Uncertainty {
  Eigen::VectorXd depth;   ///< metres
  Eigen::VectorXd normal;  ///< radians, root mean square angle
};

/// @param depth the last step's problem  @param images, state what its tensors were made of
/// @param solver has solved the last system; is used again  @param residual_deviation s above
/// @param samples 0: an empty result. The samples are the same at every call: the result is reproducible.
Uncertainty estimate_uncertainty(const DepthProblem& depth, const Observations& images, const SurfaceState& state,
                                 const DepthOptions& options, DepthSolver& solver, double residual_deviation,
                                 int samples);

}  // namespace rakelight
