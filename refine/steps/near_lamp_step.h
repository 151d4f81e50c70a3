// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The step that solves the joint lamp fit's equations (refine/steps/near_lamps.h).
#pragma once

#include "refine/steps/near_lamp_equations.h"
#include "refine/steps/near_lamps.h"

namespace rakelight {

/// What a fit or its uncertainty looks at, weighed as the options say.
std::vector<LampRegion> regions_for(const std::vector<RegionSamples>& samples, const BroadShape* shape,
                                    const NearLampOptions& options, const SurfaceState& state,
                                    const Gloss& gloss);

NearLampEquations sum_of(const std::vector<NearLampEquations>& parts);

/// Mean square residual.
double error_variance(const NearLampEquations& equations);

/// Takes out of the step what the options hold, what far lamps do not have, and what stands at its bound.
void lock_unknowns(const NearLampUnknowns& at, const NearLampOptions& options, bool hold_shape,
                   NearLampEquations& equations);

/// The step that solves the equations with their diagonal grown by the share `damping`. Strength has a free factor a
/// channel against the albedo: the smallest step is taken along it.
Eigen::VectorXd damped_step(const NearLampEquations& equations, double damping);

}  // namespace rakelight
