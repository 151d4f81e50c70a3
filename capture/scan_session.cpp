// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/scan_session.h"

#include <algorithm>

#include "capture/stack_header.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kSettleFrames = 4;  // after the exposure has been set

int repeats_of(const Rig& rig, const ScanOptions& options) {
  return options.resume ? options.resume->repeats : options.repeats.value_or(rig.repeats);
}

bool has_rgb_shot(const Rig& rig, const ScanOptions& options) {
  return options.resume ? options.resume->rgb_shot : options.rgb_shot.value_or(rig.rgb_shot);
}

}  // namespace

ScanSession::ScanSession(const Devices& devices, const Rig& the_rig, const ScanOptions& the_options,
                         const ScanProgressCallback& progress)
    : rig(the_rig),
      options(the_options),
      plan(plan_scan(rig, repeats_of(rig, options), has_rgb_shot(rig, options))),
      feed(devices.source, devices.clock,
           {rig.sensor.exposure_us, rig.sensor.readout_us, devices.source.describe().frame_period_us},
           [this] { return keep_going(); }),
      sequence(feed, devices.lights, plan, {rig.sensor.lamp_jitter_us, options.margin_us}),
      devices_(devices),
      progress_(progress) {
  start_state();
}

void ScanSession::start_state() {
  if (options.resume) {
    state = *options.resume;
    check_same_lamps();
    exposure = {state.stack.exposure_us.value_or(rig.sensor.exposure_us),
                state.stack.gain.value_or(rig.sensor.gain)};
    return;
  }
  state.stack = stack_header(devices_.source.describe(), rig, plan);
  state.repeats = repeats_of(rig, options);
  state.rgb_shot = has_rgb_shot(rig, options);
  exposure = {rig.sensor.exposure_us, rig.sensor.gain};
}

void ScanSession::check_same_lamps() const {
  const auto same = [](const Light& a, const Light& b) { return a.id == b.id && a.color == b.color; };
  const auto& before = state.stack.lights;
  if (!std::equal(before.begin(), before.end(), plan.lights.begin(), plan.lights.end(), same)) {
    throw UsageError("the unfinished scan has other lamps than rig '" + rig.name +
                     "'; resume it with its own rig file, or scan anew into another folder");
  }
  if (state.stack.color_camera.size() != devices_.source.describe().color_camera.size()) {
    throw UsageError(
        "the unfinished scan has colour images of another size; resume it with its own rig file");
  }
}

void ScanSession::tell(const std::string& stage, double fraction) {
  note(stage, fraction);
  feed.check_keep_going();
}

void ScanSession::set_exposure(const ExposureSetting& wanted) {
  exposure = wanted;
  const ExposureLock lock = devices_.source.lock_exposure(wanted.time_us, wanted.gain);
  exposure.time_us = lock.exposure_us.value_or(wanted.time_us);
  exposure.gain = lock.gain.value_or(wanted.gain);
  locked = lock.auto_exposure_off && lock.auto_white_balance_off;
  feed.set_exposure(exposure.time_us);
  state.stack.exposure_us = exposure.time_us;
  state.stack.gain = exposure.gain;
  const int from = feed.next_color().frame.index;
  while (feed.next_color().frame.index < from + kSettleFrames) {}
}

/// By the first lamp that changes the picture.
bool ScanSession::find_lag() {
  LatencyOptions latency;
  latency.response = state.stack.color_response;
  for (const RigLamp& lamp : rig.lamps) {
    const auto lag = measure_lag(feed, devices_.lights, lamp.id, latency);
    if (!lag) continue;
    sequence.set_lag(*lag);
    result.lag_us = summarise(*lag, feed.clock_fit()).lag_us;
    return true;
  }
  return false;
}

void ScanSession::find_first_lag() {
  const ExposureSetting start = exposure;
  for (const double factor : {1.0, 0.25, 4.0}) {
    if (factor != 1) set_exposure({start.time_us, start.gain * factor});
    if (find_lag()) return;
    if (options.resume) break;  // its exposure is known to be right
  }
  throw DeviceError(
      "switched every lamp on and off, but the picture never changed; check the lamps' supply and lines "
      "('rakelight lights test'), and that the sensor sees what they light");
}

void ScanSession::find_lag_again() {
  if (!find_lag())
    throw DeviceError(
        "measured the lamps' latency again, but the picture no longer changes; check their supply");
}

void ScanSession::check_epoch() {
  if (feed.clock_fit().epoch() != sequence.lag().epoch) find_lag_again();
}

Frame ScanSession::frame_of(const StepFrame& taken) {
  const SensorFrame& sensor = taken.frame.frame;
  Frame frame;
  frame.light = plan.steps[taken.step].light;
  frame.color = sensor.image;
  frame.color_time = {sensor.device_us, sensor.host_us};
  frame.led_edge_time.host_us = (taken.edge.before_us + taken.edge.after_us) / 2;
  put_depth(frame, sensor.device_us);
  return frame;
}

void ScanSession::put_depth(Frame& frame, std::int64_t device_us) {
  const SensorFrame depth = feed.take_depth_near(device_us);
  if (depth.image.empty()) return;
  frame.depth = depth.image;
  frame.depth_time = {depth.device_us, depth.host_us};
}

}  // namespace rakelight
