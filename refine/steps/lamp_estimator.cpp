// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/lamp_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "refine/steps/lighting.h"
#include "refine/steps/robust_weights.h"

namespace rakelight {
namespace {

constexpr int kFirstNear = 4;   // outer iteration: far lamps of a noisy shape are good enough as a start by then
constexpr int kChoice = 10;     // outer iteration: the near fit has settled enough to be compared
constexpr float kStartInverseDistance = 1.0f;  // 1/m; 0.5, 1 and 2 m were seen to reach the same point
constexpr double kClearlyBetter = 1.02;        // far residual / near residual above which near lamps stay

/// The alternation of lamps and shape creeps towards the right distance: going twice as far halves the iterations.
constexpr float kOverRelaxation = 2.0f;
constexpr float kMaxInverseDistance = 10.0f;
constexpr double kSettledChange = 0.001;  // of the distance, an iteration, median over the lamps

Lamp at_position(const Lamp& lamp, const Eigen::Vector3d& position, const LampScene& scene) {
  const Eigen::Vector3f offset = position.cast<float>() - scene.center;
  Lamp result = lamp;
  result.direction = offset.normalized();
  result.inverse_distance = 1.0f / offset.norm();
  return result;
}

/// Relative, of the near lamps of an iteration.
double median_distance_change(const std::vector<Lamp>& before, const std::vector<Lamp>& after) {
  std::vector<double> changes;
  for (size_t i = 0; i < after.size(); ++i) {
    const auto old = static_cast<double>(before[i].inverse_distance);
    if (after[i].near && old > 0) changes.push_back(std::abs(static_cast<double>(after[i].inverse_distance) / old - 1));
  }
  if (changes.empty()) return 0;
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return *middle;
}

std::string with_number(const char* format, double number) {
  char text[160];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace

void LampEstimator::update(const Observations& images, SurfaceState& state, int iteration) {
  const int first_near = options_.positions == LampPositions::estimated ? kFirstNear : 2;
  if (options_.model != LampModel::far && iteration == first_near) start_near(images, state);
  if (!near_) {
    state.lamps = estimate_far_lamps(images, state);
    return;
  }
  NearLampOptions fit;
  fit.max_inverse_distance = kMaxInverseDistance;
  fit.fixed_positions = options_.positions == LampPositions::fixed;
  const std::vector<Lamp> before = state.lamps;
  state.lamps = estimate_near_lamps(images, state, fit);
  const int since = iteration - first_near;
  if (!fit.fixed_positions && since >= 2 && iteration <= options_.settle_after) {
    for (size_t i = 0; i < before.size(); ++i) {
      float& kappa = state.lamps[i].inverse_distance;
      const float old = before[i].inverse_distance;
      kappa = std::clamp(old + kOverRelaxation * (kappa - old), 0.0f, kMaxInverseDistance);
    }
  }
  settled_ = median_distance_change(before, state.lamps) < kSettledChange;
  if (options_.model == LampModel::automatic && iteration == kChoice) choose(images, state);
}

void LampEstimator::start_near(const Observations& images, SurfaceState& state) {
  near_ = true;
  explanation_ = "near lamps: asked for";
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    Lamp& lamp = state.lamps[i];
    if (images.colored_lamps[i]) continue;  // three lamps at once have no one position
    lamp = near_from_far(lamp, kStartInverseDistance);
    if (options_.positions != LampPositions::estimated && images.lamp_positions[i])
      lamp = at_position(lamp, *images.lamp_positions[i], state.scene);
  }
}

void LampEstimator::choose(const Observations& images, SurfaceState& state) {
  const double near_scale = residual_scale(images, state);
  SurfaceState far = state;
  far.lamps.clear();
  far.lamps = estimate_far_lamps(images, far);  // without shadows first, then with
  far.lamps = estimate_far_lamps(images, far);
  const double far_scale = residual_scale(images, far);
  far_over_near_ = near_scale > 0 ? far_scale / near_scale : 1;
  near_ = far_over_near_ > kClearlyBetter;
  settled_ = settled_ || !near_;
  if (!near_) state.lamps = far.lamps;
  explanation_ = with_number(near_ ? "near lamps: the far model's residual is %.2f times as large"
                                   : "far lamps: the near model fits no better (far / near residual %.2f)",
                             far_over_near_);
}

}  // namespace rakelight
