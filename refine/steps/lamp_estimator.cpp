// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/lamp_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "refine/steps/albedo.h"
#include "refine/steps/lighting.h"
#include "refine/steps/matt_images.h"
#include "refine/steps/near_lamp_search.h"
#include "refine/steps/robust_weights.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kFirstNear =
    4;                      // outer iteration: far lamps of a noisy shape are good enough as a start by then
constexpr int kChoice = 8;  // outer iteration: the near fit has settled enough to be compared
constexpr float kStartInverseDistance = 1.0f;  // 1/m; 0.5, 1 and 2 m were seen to reach the same point
constexpr double kClearlyBetter = 1.02;        // far residual / near residual above which near lamps stay
/// Light that turns less than this between the object's centre and its rim (radians) is taken as parallel. So small a turn
/// tilts the shape at the rim by at most 1.7 degrees, less than normals err anyway under shadows and highlights (2 degrees),
/// while the near model's further unknowns would fit what the model lacks. Nothing hangs on the figure: lamps at arm's
/// length turn by 0.1 and more, those of far rigs were found to turn by 0.001 or so.
constexpr double kLeastTurn = 0.03;
constexpr int kHighlightsEvery = 4;  // outer iterations
constexpr int kLastRounds = 8;       // of the last fit: weights and highlights taken anew
constexpr int kSearchRounds = 4;     // of lamps and albedo in turn
constexpr float kMaxInverseDistance = 10.0f;
constexpr double kSettledTurn = 1e-3;  // radians an iteration: normals err by ten times as much and more

/// Size of all errors of a lamp's position to those that differ between regions of the picture: the sensor's broad errors,
/// highlights and a wrong lobe are shared by all. Measured as 4 to 12 on rendered rigs of six objects.
constexpr double kSharedErrors = 8;

Lamp at_position(const Lamp& lamp, const Eigen::Vector3d& position, const LampScene& scene) {
  const Eigen::Vector3f offset = position.cast<float>() - scene.center;
  Lamp result = lamp;
  result.direction = offset.normalized();
  result.inverse_distance = 1.0f / offset.norm();
  return result;
}

/// How far the light's direction at the object's rim turned, radians: what a change of distance does to the shape.
/// Median over the near lamps. A lamp that is really far may wander without end between 30 m and 3 km: that is nothing.
double turn_at_rim(const std::vector<Lamp>& before, const std::vector<Lamp>& after, double radius_m) {
  std::vector<double> turns;
  for (size_t i = 0; i < after.size(); ++i) {
    if (!after[i].near) continue;
    turns.push_back(radius_m *
                    std::abs(static_cast<double>(after[i].inverse_distance - before[i].inverse_distance)));
  }
  if (turns.empty()) return 0;
  const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle, turns.end());
  return *middle;
}

/// Root mean square distance of the surface points from their centre, metres.
double object_radius(const SurfaceState& state) {
  return std::sqrt(
      static_cast<double>((state.points.colwise() - state.scene.center).colwise().squaredNorm().mean()));
}

std::string with_number(const char* format, double number) {
  char text[160];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace

LampEstimator::LampEstimator(const LampOptions& options) : options_(options) {
  if (options.harmonics == 2) explanation_ = "far lamps with second-order harmonics: asked for";
}

void LampEstimator::update(const RefineProblem& problem, const DepthPrior& prior, SurfaceState& state,
                           int iteration) {
  const Observations& images = problem.images;
  const int first_near = options_.positions == LampPositions::estimated ? kFirstNear : 2;
  const bool may_be_near = options_.model != LampModel::far && options_.harmonics == 1;
  if (near_ || (may_be_near && iteration <= kChoice))  // far lamps shine on all points alike
    state.points = surface_points(problem.grid, state.zeta);
  if (may_be_near && iteration == first_near) start_near(images, state);
  if (!near_) {
    state.lamps = estimate_far_lamps(images, state);
    return;
  }
  const std::vector<Lamp> before = state.lamps;
  const BroadShape shape{problem.grid, prior};
  NearLampOptions options = fit_options();
  options.highlights = iteration >= kChoice;
  state.zeta += fit_near_lamps(samples_, &shape, options, state, gloss_);
  state.normals = surface_normals(problem.grid, problem.corners, state.zeta);
  state.points = surface_points(problem.grid, state.zeta);
  state.albedo =
      estimate_albedo(images, state);  // the fit eliminated it: the old one knows nothing of these lamps
  settled_ = turn_at_rim(before, state.lamps, object_radius(state)) < kSettledTurn;
  if (options_.model == LampModel::automatic && iteration == kChoice) choose(images, state);
  if (iteration >= kChoice && iteration % kHighlightsEvery == 0) renew_matt_images(images, state);
}

void LampEstimator::renew_matt_images(const Observations& seen, const SurfaceState& state) {
  if (!near_ || gloss_.isZero(0)) {
    matt_.reset();
    return;
  }
  if (!matt_) matt_ = seen;
  take_off_highlights(seen, state, gloss_, *matt_);
}

std::vector<LampUncertainty> LampEstimator::positions(const RefineProblem& problem, const DepthPrior& prior,
                                                      SurfaceState state) const {
  if (!near_) return {};
  const BroadShape shape{problem.grid, prior};
  NearLampOptions options = fit_options();
  options.highlights = true;
  Gloss gloss = gloss_;
  for (int round = 0; round < kLastRounds; ++round) {
    state.zeta += fit_near_lamps(samples_, &shape, options, state, gloss);
    state.normals = surface_normals(problem.grid, problem.corners, state.zeta);
    state.points = surface_points(problem.grid, state.zeta);
  }
  std::vector<LampUncertainty> result = near_lamp_uncertainty(samples_, &shape, options, state, gloss);
  for (LampUncertainty& lamp : result) {
    lamp.position_covariance *= kSharedErrors * kSharedErrors;
    lamp.distance_deviation *= kSharedErrors;
    lamp.direction_deviation *= kSharedErrors;
  }
  return result;
}

NearLampOptions LampEstimator::fit_options() const {
  NearLampOptions fit;
  fit.max_inverse_distance = kMaxInverseDistance;
  fit.fixed_positions = options_.positions == LampPositions::fixed;
  return fit;
}

void LampEstimator::start_near(const Observations& images, SurfaceState& state) {
  near_ = true;
  samples_ = sample_lamp_regions(images, state);
  far_state_ = state;
  explanation_ = "near lamps: asked for";
  if (state.weight.empty()) state.weight = usable_weights(images);  // the fit of near lamps reads them
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    Lamp& lamp = state.lamps[i];
    if (images.colored_lamps[i]) continue;  // three lamps at once have no one position
    lamp = near_from_far(lamp, kStartInverseDistance);
    if (options_.positions == LampPositions::estimated) continue;
    if (!images.lamp_positions[i]) {
      throw InputError("light " + images.light_ids[i], "has no position_m in the stack",
                       "give it one, or let positions be estimated (--lamp-positions estimated)");
    }
    lamp = at_position(lamp, *images.lamp_positions[i], state.scene);
  }
  if (options_.positions != LampPositions::estimated) return;
  state.weight = usable_weights(images);
  state.albedo.setOnes();
  const NearLampSearch search(images, state);
  for (int round = 0; round < kSearchRounds; ++round) {
    state.lamps = search.lamps(state);
    state.albedo = estimate_albedo(images, state);
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
  std::vector<Lamp> parallel = state.lamps;
  for (Lamp& lamp : parallel) lamp.inverse_distance = 0;
  const double turn = turn_at_rim(parallel, state.lamps, object_radius(state));
  const bool better = far_over_near_ > kClearlyBetter;
  near_ = better && turn > kLeastTurn;
  settled_ = settled_ || !near_;
  if (!near_) state = std::move(far_state_);
  if (better && !near_) {
    explanation_ = with_number("far lamps: their light turns by %.3f rad over the object only", turn);
  } else {
    explanation_ = with_number(near_ ? "near lamps: the far model's residual is %.2f times as large"
                                     : "far lamps: the near model fits no better (far / near residual %.2f)",
                               far_over_near_);
  }
}

}  // namespace rakelight
