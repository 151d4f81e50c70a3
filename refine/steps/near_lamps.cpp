// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "refine/steps/near_lamp_equations.h"
#include "refine/steps/near_lamp_incidence.h"
#include "refine/steps/near_lamp_prior.h"

namespace rakelight {
namespace {

using Unknowns = NearLampUnknowns;

/// A step that takes less than this share of the energy is the last of its call: the next call sees a better surface.
constexpr double kLeastGain = 1e-4;

NearLampEquations sum_of(const std::vector<NearLampEquations>& parts) {
  NearLampEquations sum = parts.front();
  for (size_t k = 1; k < parts.size(); ++k) sum += parts[k];
  return sum;
}

double error_variance(const NearLampEquations& equations) {
  return equations.energy / std::max(1.0, equations.samples);
}

/// Takes an unknown out of the step.
void lock(NearLampEquations& equations, Eigen::Index k) {
  equations.A.row(k).setZero();
  equations.A.col(k).setZero();
  equations.A(k, k) = 1;
  equations.b[k] = 0;
}

void lock_unknowns(const Unknowns& at, bool fixed_positions, bool hold_shape, bool hold_gloss,
                   NearLampEquations& equations) {
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Lamp& lamp = at.lamps[i];
    const Eigen::Index first = at.lamp_at(static_cast<Eigen::Index>(i));
    const bool at_infinity = lamp.inverse_distance <= 0 && equations.b[first + 2] < 0;
    for (Eigen::Index k = 0; k < Unknowns::kLamp; ++k) {
      const bool position = fixed_positions && k < 3;
      if (!lamp.near || position || (k == 2 && at_infinity)) lock(equations, first + k);
    }
  }
  for (Eigen::Index k = 0; k < Unknowns::kAim + Unknowns::kShape; ++k)
    if (k < Unknowns::kAim ? fixed_positions : hold_shape) lock(equations, at.aim_at() + k);
  for (Eigen::Index k = 0; k < Unknowns::kGloss; ++k)
    if (hold_gloss || (at.gloss[k] <= 0 && equations.b[at.gloss_at() + k] < 0))
      lock(equations, at.gloss_at() + k);
}

/// The step that solves the equations with their diagonal grown by the share `damping`. Strength has a free factor a
/// channel against the albedo: the smallest step is taken along it.
Eigen::VectorXd damped_step(const NearLampEquations& equations, double damping) {
  Eigen::MatrixXd A = equations.A;
  A.diagonal() *= 1 + damping;
  A.diagonal().array() += 1e-12 * equations.A.trace() / static_cast<double>(equations.A.rows());
  return A.ldlt().solve(equations.b);
}

std::vector<LampRegion> regions_for(const Observations& images, const BroadShape* shape,
                                    const NearLampOptions& options, const SurfaceState& state,
                                    const Gloss& gloss) {
  std::vector<LampRegion> regions = sample_lamp_regions(images, shape, state, options.pixels);
  if (options.highlights) forget_shadows(state, gloss, regions);
  return regions;
}

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

Eigen::VectorXd fit_near_lamps(const Observations& images, const BroadShape* shape,
                               const NearLampOptions& options, SurfaceState& state, Gloss& gloss) {
  const std::vector<LampRegion> regions = regions_for(images, shape, options, state, gloss);
  const Eigen::Vector3f middle = state.points.rowwise().mean();
  Unknowns at{state.lamps, state.scene, gloss};
  double damping = 1e-4;
  bool settled = false;
  for (int step = 0; step < options.steps && !settled; ++step) {
    NearLampEquations equations = sum_of(near_lamp_equations(regions, at));
    const double variance = error_variance(equations);
    equations += near_lamp_prior(at, middle, variance);
    lock_unknowns(at, options.fixed_positions, shape == nullptr, !options.highlights, equations);
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
  Eigen::VectorXd change = Eigen::VectorXd::Zero(images.pixels);
  if (shape)
    for (int p = 0; p < images.pixels; ++p) change[p] = broad_changes(state, p).cast<double>().dot(at.shape);
  state.lamps = at.lamps;
  state.scene = at.scene;
  gloss = at.gloss;
  return change;
}

std::vector<LampUncertainty> near_lamp_uncertainty(const Observations& images, const BroadShape* shape,
                                                   const NearLampOptions& options, const SurfaceState& state,
                                                   const Gloss& gloss) {
  const Unknowns at{state.lamps, state.scene, gloss};
  const std::vector<NearLampEquations> regions =
      near_lamp_equations(regions_for(images, shape, options, state, gloss), at);
  NearLampEquations all = sum_of(regions);
  all += near_lamp_prior(at, state.points.rowwise().mean(), error_variance(all));
  Eigen::MatrixXd steps(at.size(), static_cast<Eigen::Index>(regions.size()));
  for (size_t left_out = 0; left_out < regions.size(); ++left_out) {
    NearLampEquations rest = all;
    rest.A -= regions[left_out].A;
    rest.b -= regions[left_out].b;
    lock_unknowns(at, options.fixed_positions, shape == nullptr, !options.highlights, rest);
    steps.col(static_cast<Eigen::Index>(left_out)) = damped_step(rest, 1e-6);
  }
  steps.colwise() -= steps.rowwise().mean().eval();
  const double count = static_cast<double>(regions.size());
  std::vector<LampUncertainty> result;
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    const Lamp& lamp = state.lamps[i];
    const Eigen::Index k = at.lamp_at(static_cast<Eigen::Index>(i));
    const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
    Eigen::Matrix3d J;  // d X / d (tangents, kappa), X = centre + d / kappa
    J.leftCols<2>() = lamp_tangents(lamp.direction).cast<double>() / kappa;
    J.col(2) = -lamp.direction.cast<double>() / (kappa * kappa);
    const Eigen::MatrixXd own = steps.middleRows<3>(k);
    const Eigen::Matrix3d spread = (count - 1) / count * own * own.transpose();
    LampUncertainty u;
    u.position = lamp_position(lamp, state.scene);
    u.position_covariance = J * spread * J.transpose();
    u.distance_deviation = std::sqrt(spread(2, 2)) / (kappa * kappa);
    u.direction_deviation = std::sqrt(spread(0, 0) + spread(1, 1));
    result.push_back(u);
  }
  return result;
}

Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene) {
  const double kappa = std::max(1e-3, static_cast<double>(lamp.inverse_distance));
  return scene.center.cast<double>() + lamp.direction.cast<double>() / kappa;
}

}  // namespace rakelight
