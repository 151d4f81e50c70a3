// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cauchy weights: cast shadows, highlights and reflections are samples the model cannot explain, so each sample is
// weighed by 1 / (1 + (r / (k sigma))^2), sigma the robust scale 1.4826 median |r| of all residuals. The weights are made where
// they are used first: reweigh_and_accumulate (refine/steps/photometric_tensor.h).
#pragma once

#include "refine/observations.h"
#include "refine/surface_state.h"

namespace rakelight {

/// sigma = 1.4826 median over usable samples of |rho S - I|, linear radiance.
double residual_scale(const Observations& images, const SurfaceState& state);

/// The same of one image.
double residual_scale_of_image(const Observations& images, const SurfaceState& state, int image);

/// Median over usable samples of the radiance: the brightness that errors are held against.
double median_radiance(const Observations& images);

/// 1 where a channel is usable, else 0.
std::vector<float> usable_weights(const Observations& images);

}  // namespace rakelight
