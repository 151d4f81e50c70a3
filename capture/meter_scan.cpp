// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/meter_scan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "capture/step_pictures.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kRounds = 6;
constexpr int kPasses = 4;      // over what was dropped
constexpr double kObeys = 0.5;  // share of a change in exposure that must show in the picture
constexpr double kClearChange = 0.25;

/// One picture of each step, dark first, the lamps backwards: an error in timing then differs from the sequence's.
StepPictures take_pictures(ScanSession& session) {
  StepPictures pictures;
  const auto take = [&](const StepFrame& taken) {
    if (pictures.count(taken.step) == 0) pictures[taken.step] = session.frame_of(taken);
  };
  std::vector<std::size_t> steps(session.plan.steps.size() - 1);
  std::iota(steps.begin(), steps.end(), std::size_t{0});
  std::reverse(steps.begin() + 1, steps.end());
  for (int pass = 0; pass < kPasses && !steps.empty(); ++pass) {
    session.sequence.run(steps, 1, take);
    session.check_epoch();
    const auto taken = [&](std::size_t step) { return pictures.count(step) != 0; };
    steps.erase(std::remove_if(steps.begin(), steps.end(), taken), steps.end());
  }
  if (steps.empty()) return pictures;
  throw DeviceError(
      "waited for a whole frame under each lamp, but too many frames are dropped; use another USB port, "
      "or fewer streams on this one");
}

/// Whether the level changed as commanded; where one of the pictures clips nothing can be said.
bool obeyed(const Brightness& before, const Brightness& now, double commanded, const MeteringLimits& limits) {
  if (before.saturated > limits.max_saturated || now.saturated > limits.max_saturated) return true;
  if (before.level <= 0 || std::abs(commanded - 1) < kClearChange) return true;
  return (now.level / before.level - 1) / (commanded - 1) > kObeys;
}

MeteringLimits limits_of(const ScanSession& session) {
  MeteringLimits limits = session.options.metering;
  limits.max_time_us = std::min(limits.max_time_us, 0.97 * session.feed.timing().period_us);
  return limits;
}

/// @return what the exposure was changed by
double change_exposure(ScanSession& session, const ExposureSetting& better) {
  const ExposureSetting before = session.exposure;
  session.set_exposure(better);
  // Some devices stamp a frame's beginning, others its end: with another exposure the lag may be another.
  if (session.exposure.time_us != before.time_us) session.find_lag_again();
  return better.time_us * better.gain / (before.time_us * before.gain);
}

}  // namespace

void meter(ScanSession& session) {
  const ExposureSetting start = session.exposure;
  Brightness before;
  double commanded = 1;
  for (int round = 1;; ++round) {
    session.tell("metering", 0.1 + 0.25 * std::min(round, 2) / 2);
    const StepPictures pictures = take_pictures(session);
    const SceneInPictures seen = examine(session.state.stack, pictures);
    const Brightness now = brightness_of(seen, pictures, session.state.stack.color_response);
    session.result.metering_rounds = round;
    const bool follows = round == 1 || obeyed(before, now, commanded, session.options.metering);
    if (!follows)
      session.warn("the sensor does not follow the exposure it is told: check its automatic exposure");
    const auto better = better_exposure(now, session.exposure, start, limits_of(session));
    if (!follows || !session.options.meter || !better || round == kRounds)
      return learn_lamps(seen, pictures, session.rig.lamps, session.state);
    before = now;
    commanded = change_exposure(session, *better);
  }
}

}  // namespace rakelight
