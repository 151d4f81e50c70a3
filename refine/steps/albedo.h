// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (27), (28): the albedo of each pixel and channel, given shape and lamps. The system is diagonal:
//
//     rho_c = sum_i w_i S_ic I_ic / sum_i w_i S_ic^2,      S_ic = shading
#pragma once

#include "refine/observations.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Albedo from all images, 3 x pixels. Pixels that no sample lights keep the state's albedo.
Eigen::Matrix3Xf estimate_albedo(const Observations& images, const SurfaceState& state);

/// rho and s share a free scale a channel: makes mean(rho_c) = 1 and scales the lamps to match.
void normalize_albedo(SurfaceState& state);

}  // namespace rakelight
