// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The robust solver of the methods that use one image. Lamps and albedo by turns, then one Gauss-Newton step of the
// depth on the residual of the shading itself,
//
//     E(zeta) = sum_p sum_c (l_c . n(zeta) + phi_c - I_c / rho_c)^2 + lambda_z |zeta - z0|^2 + lambda_l |f D2 zeta|^2
//
// with the symmetric stencil, weights that spare occlusion edges, second differences D2 that do so too
// (refine/steps/curvature_prior.h) and the albedo of refine/steps/albedo_smooth.h. Nothing but measured errors balances
// the terms: lambda_z is noise_ratio (shading error / depth error)^2 on blocks, lambda_l is smoothness (shading error)^2,
// so 1 / sqrt(smoothness) is the change of tilt from pixel to pixel, in radians, that costs as much as one sample's error.
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Which lamps light the image.
enum class ImageLight {
  colored,  ///< red, green and blue ones at once: each channel has a light of its own
  white,    ///< any: the channels share one light, and its colour is part of the albedo
};

/// With white light, one equation a pixel for two slopes, paint and relief are told apart by what else is known: the image
/// says how much smoothness the sensor's depth bears (refine/steps/smoothness_choice.h), and the result stays within what
/// the sensor's noise allows (refine/steps/sensor_bound.h); where it would not, the start is the result, with a warning.
/// @param problem with exactly one image  @throws InputError when a coloured image's channels share one light
MethodResult refine_by_shading(const RefineProblem& problem, const RefineOptions& options, ImageLight light,
                               const IterationCallback& after_iteration);

}  // namespace rakelight
