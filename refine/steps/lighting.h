// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (26): the light of each image and channel, given shape and albedo, by weighted least squares
//
//     min_s sum_p w (rho_c [n, 1] s_ic - I_ic)^2          4 unknowns: l (3) and phi
//
// and, with second-order harmonics, [n, 1, the five quadratic ones] and 9 unknowns.
#pragma once

#include "refine/observations.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Far lamps of all images. With attached shadows a sample that the state's lamp leaves dark speaks for phi only.
/// The order of the harmonics is the state's; the second follows the shadow's soft edge itself and knows no clamp.
/// @return one lamp an image; the old lamp is kept where an image has too few usable samples.
std::vector<Lamp> estimate_far_lamps(const Observations& images, const SurfaceState& state);

/// Spread of the light directions: the singular values of the stacked, normalised l, largest first. Photometric stereo
/// needs three; a last value near 0 means that the lamps lie in a plane and the shape is not determined by them.
Eigen::Vector3d lamp_singular_values(const std::vector<Lamp>& lamps, const LampScene& scene);

}  // namespace rakelight
