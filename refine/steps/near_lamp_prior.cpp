// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_prior.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr double kAmbientShare = 0.2;  // expected ambient light, share of a lamp's
constexpr double kAimDeviation =
    0.1;  // expected distance of the aim from the middle of the seen surface, metres
constexpr double kGlossDeviation = 0.3;  // expected peak of the highlights, share of a white surface
/// Samples whose errors agree, as those of shadows do: so many of the fit's count as one against what is expected.
constexpr double kSamplesThatAgree = 50;
constexpr double kFarInverse = 1 / 3.0;  // kappa_0 of log_lamp_power, 1/m
constexpr double kLeastStrength = 1e-6;

double far_inverse_squared(const Lamp& lamp) {
  const auto kappa = static_cast<double>(lamp.inverse_distance);
  return kappa * kappa + kFarInverse * kFarInverse;
}

double mean_strength(const Lamp& lamp) {
  return std::max(kLeastStrength, static_cast<double>(lamp.strength.mean()));
}

double mean_log_power(const std::vector<Lamp>& lamps) {
  double sum = 0, count = 0;
  for (const Lamp& lamp : lamps) {
    if (!lamp.near) continue;
    sum += log_lamp_power(lamp);
    ++count;
  }
  return sum / std::max(1.0, count);
}

}  // namespace

double log_lamp_power(const Lamp& lamp) { return std::log(mean_strength(lamp) / far_inverse_squared(lamp)); }

NearLampEquations near_lamp_prior(const NearLampUnknowns& at, const Eigen::Vector3f& middle,
                                  double variance) {
  NearLampEquations result(at.size());
  const auto add = [&](Eigen::Index k, double value, double deviation) {
    const double weight = kSamplesThatAgree * variance / (deviation * deviation + 1e-12);
    result.A(k, k) += weight;
    result.b[k] -= weight * value;
    result.energy += weight * value * value;
  };
  // The mean is held: it moves little, and it is free besides, for the albedo takes up any factor.
  const double usual = mean_log_power(at.lamps);
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Lamp& lamp = at.lamps[i];
    if (!lamp.near) continue;
    const double ambient = kAmbientShare * static_cast<double>(lamp.strength.maxCoeff());
    for (int c = 0; c < 3; ++c)
      add(at.lamp_at(static_cast<Eigen::Index>(i)) + 6 + c, static_cast<double>(lamp.phi[c]), ambient);
    Eigen::Vector4d slope;  // of the log power, by kappa and the strengths
    slope << -2 * static_cast<double>(lamp.inverse_distance) / far_inverse_squared(lamp),
        Eigen::Vector3d::Constant(1 / (3 * mean_strength(lamp)));
    const double off = log_lamp_power(lamp) - usual;
    const double weight = kSamplesThatAgree * variance / (kLogPowerDeviation * kLogPowerDeviation);
    const Eigen::Index kappa_at = at.lamp_at(static_cast<Eigen::Index>(i)) + 2;
    result.A.block<4, 4>(kappa_at, kappa_at) += weight * slope * slope.transpose();
    result.b.segment<4>(kappa_at) -= weight * off * slope;
    result.energy += weight * off * off;
  }
  for (int k = 0; k < NearLampUnknowns::kAim; ++k)
    add(at.aim_at() + k, static_cast<double>(at.scene.center[k] - middle[k]), kAimDeviation);
  for (int k = 0; k < NearLampUnknowns::kGloss; ++k) add(at.gloss_at() + k, at.gloss[k], kGlossDeviation);
  return result;
}

}  // namespace rakelight
