// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_step.h"

#include <Eigen/Dense>
#include <algorithm>

#include "refine/steps/near_lamp_shadows.h"

namespace rakelight {
namespace {

/// Takes an unknown out of the step.
void lock(NearLampEquations& equations, Eigen::Index k) {
  equations.A.row(k).setZero();
  equations.A.col(k).setZero();
  equations.A(k, k) = 1;
  equations.b[k] = 0;
}

}  // namespace

std::vector<LampRegion> regions_for(const std::vector<RegionSamples>& samples, const BroadShape* shape,
                                    const NearLampOptions& options, const SurfaceState& state,
                                    const Gloss& gloss) {
  std::vector<LampRegion> regions = lamp_regions(samples, shape, state);
  if (options.highlights) forget_shadows(state, gloss, regions);
  return regions;
}

NearLampEquations sum_of(const std::vector<NearLampEquations>& parts) {
  NearLampEquations sum = parts.front();
  for (size_t k = 1; k < parts.size(); ++k) sum += parts[k];
  return sum;
}

double error_variance(const NearLampEquations& equations) {
  return equations.energy / std::max(1.0, equations.samples);
}

void lock_unknowns(const NearLampUnknowns& at, const NearLampOptions& options, bool hold_shape,
                   NearLampEquations& equations) {
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Lamp& lamp = at.lamps[i];
    const Eigen::Index first = at.lamp_at(static_cast<Eigen::Index>(i));
    const bool at_infinity = lamp.inverse_distance <= 0 && equations.b[first + 2] < 0;
    for (Eigen::Index k = 0; k < NearLampUnknowns::kLamp; ++k) {
      const bool position = options.fixed_positions && k < 3;
      if (!lamp.near || position || (k == 2 && at_infinity)) lock(equations, first + k);
    }
  }
  for (Eigen::Index k = 0; k < NearLampUnknowns::kAim + NearLampUnknowns::kShape; ++k)
    if (k < NearLampUnknowns::kAim ? options.fixed_positions : hold_shape) lock(equations, at.aim_at() + k);
  for (Eigen::Index k = 0; k < NearLampUnknowns::kGloss; ++k)
    if (!options.highlights || (at.gloss[k] <= 0 && equations.b[at.gloss_at() + k] < 0))
      lock(equations, at.gloss_at() + k);
}

Eigen::VectorXd damped_step(const NearLampEquations& equations, double damping) {
  Eigen::MatrixXd A = equations.A;
  A.diagonal() *= 1 + damping;
  A.diagonal().array() += 1e-12 * equations.A.trace() / static_cast<double>(equations.A.rows());
  return A.ldlt().solve(equations.b);
}

}  // namespace rakelight
