// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The robust solver of the methods that use one image. Lamps and albedo by turns, then one Gauss-Newton step of the
// depth on the residual of the shading itself,
//
//     E(zeta) = sum_p sum_c (l_c . n(zeta) + phi_c - I_c / rho_c)^2 + lambda_z |zeta - z0|^2 + lambda_l |f Lap zeta|^2
//
// with the symmetric stencil, weights that spare occlusion edges, a Laplacian cut at depth jumps and the albedo of
// refine/steps/albedo_smooth.h.
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Which lamps light the image.
enum class ImageLight {
  colored,  ///< red, green and blue ones at once: each channel has a light of its own
  white,    ///< any: the channels share one light, and its colour is part of the albedo
};

/// The start of a single-image method: z0, albedo 1, no lamps yet.
SurfaceState initial_shading_state(const RefineProblem& problem, const RefineOptions& options);

/// @param problem with exactly one image
MethodResult refine_by_shading(const RefineProblem& problem, const RefineOptions& options, ImageLight light,
                               const IterationCallback& after_iteration);

}  // namespace rakelight
