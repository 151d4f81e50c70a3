// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "refine/steps/near_lamp_incidence.h"
#include "refine/steps/near_lamp_prior.h"
#include "refine/steps/near_lamp_step.h"

namespace rakelight {

std::vector<LampUncertainty> near_lamp_uncertainty(const std::vector<RegionSamples>& samples,
                                                   const BroadShape* shape, const NearLampOptions& options,
                                                   const SurfaceState& state, const Gloss& gloss) {
  const NearLampUnknowns at{state.lamps, state.scene, gloss};
  const std::vector<NearLampEquations> regions =
      near_lamp_equations(regions_for(samples, shape, options, state, gloss), at);
  NearLampEquations all = sum_of(regions);
  all += near_lamp_prior(at, state.points.rowwise().mean(), error_variance(all));
  Eigen::MatrixXd steps(at.size(), static_cast<Eigen::Index>(regions.size()));
  for (size_t left_out = 0; left_out < regions.size(); ++left_out) {
    NearLampEquations rest = all;
    rest.A -= regions[left_out].A;
    rest.b -= regions[left_out].b;
    lock_unknowns(at, options, shape == nullptr, rest);
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

}  // namespace rakelight
