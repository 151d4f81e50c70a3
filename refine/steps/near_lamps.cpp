// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamps.h"

#include <algorithm>
#include <cmath>

#include "refine/steps/near_lamp_prior.h"
#include "refine/steps/near_lamp_step.h"

namespace rakelight {
namespace {

using Unknowns = NearLampUnknowns;

/// A step that takes less than this share of the energy is the last of its call: the next call sees a better surface.
constexpr double kLeastGain = 1e-4;

}  // namespace

Lamp near_from_far(const Lamp& far, float inverse_distance) {
  Lamp lamp = far;
  lamp.near = true;
  const Eigen::Vector3f sum = far.l.colwise().sum().transpose();
  if (sum.norm() > 0) lamp.direction = sum.normalized();
  lamp.strength = far.l.rowwise().norm();
  lamp.inverse_distance = inverse_distance;
  return lamp;
}

Eigen::VectorXd fit_near_lamps(const std::vector<RegionSamples>& samples, const BroadShape* shape,
                               const NearLampOptions& options, SurfaceState& state, Gloss& gloss) {
  const std::vector<LampRegion> regions = regions_for(samples, shape, options, state, gloss);
  const Eigen::Vector3f middle = state.points.rowwise().mean();
  Unknowns at{state.lamps, state.scene, gloss};
  double damping = 1e-4;
  bool settled = false;
  for (int step = 0; step < options.steps && !settled; ++step) {
    NearLampEquations equations = sum_of(near_lamp_equations(regions, at));
    const double variance = error_variance(equations);
    equations += near_lamp_prior(at, middle, variance);
    lock_unknowns(at, options, shape == nullptr, equations);
    const auto energy = [&](const Unknowns& u) {
      return near_lamp_energy(regions, u) + near_lamp_prior(u, middle, variance).energy;
    };
    const double before = energy(at);
    for (int attempt = 0; attempt < 6; ++attempt, damping *= 10) {
      const Eigen::VectorXd change = damped_step(equations, damping);
      if (!change.allFinite()) continue;
      const Unknowns candidate = at.moved(change, options.max_inverse_distance);
      const double after = energy(candidate);
      if (!(after <= before)) continue;
      at = candidate;
      damping = std::max(damping * 0.1, 1e-8);
      settled = before - after < kLeastGain * before;
      break;
    }
  }
  Eigen::VectorXd change = shape ? broad_change(state, at.shape) : Eigen::VectorXd::Zero(state.zeta.size());
  state.lamps = at.lamps;
  state.scene = at.scene;
  gloss = at.gloss;
  return change;
}

Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene) {
  const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
  return scene.center.cast<double>() + lamp.direction.cast<double>() / kappa;
}

}  // namespace rakelight
