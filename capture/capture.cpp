// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/capture.h"

#include <algorithm>
#include <utility>

#include "capture/frame_keeper.h"
#include "capture/meter_scan.h"
#include "capture/scan_session.h"
#include "capture/step_pictures.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// Lamps off and source stopped on every way out.
class AllOff {
 public:
  explicit AllOff(const Devices& devices) : devices_(devices) {}
  AllOff(const AllOff&) = delete;
  AllOff& operator=(const AllOff&) = delete;
  ~AllOff() {
    try {
      devices_.lights.all_off();
    } catch (const std::exception&) {  // on the way out of another failure, which is the one to tell
    }
    try {
      devices_.source.stop();
    } catch (const std::exception&) {}
  }

 private:
  const Devices& devices_;
};

void take_sequence(ScanSession& session, FrameKeeper& keeper) {
  const auto take = [&](const StepFrame& taken) { keeper.take(taken); };
  const ExposureWindow span = session.sequence.run(keeper.missing_steps(), 0, take);
  session.result.sensor_time_us = span.closes_us - span.opens_us;
}

void retake_what_failed(ScanSession& session, FrameKeeper& keeper) {
  const auto take = [&](const StepFrame& taken) { keeper.take(taken); };
  for (int pass = 0; pass < session.options.max_retakes; ++pass) {
    session.check_epoch();
    const std::vector<std::size_t> steps = keeper.missing_steps();
    if (steps.empty()) return;
    for (const std::size_t step : steps) session.result.retaken += keeper.missing_images(step);
    session.sequence.run(steps, 0, take);
  }
}

void measure_saturation(ScanSession& session) {
  StepPictures pictures;
  for (const Frame& frame : session.state.stack.frames) {
    if (!frame.color.empty()) pictures[pictures.size()] = frame;
  }
  if (pictures.empty() || pictures.at(0).light) return;
  const SceneInPictures seen = examine(session.state.stack, pictures);
  session.result.saturated = brightness_of(seen, pictures, session.state.stack.color_response).saturated;
  if (session.result.saturated > session.options.metering.max_saturated)
    session.warn(
        "over 1 % of the object is saturated under some lamp: lower exposure or gain in the rig file, or "
        "scan with metering");
}

ScanResult finish(ScanSession& session, FrameKeeper& keeper) {
  keeper.settle();
  if (!session.locked)
    session.warn("the sensor does not say that its automatic exposure and white balance are off");
  auto& frames = session.state.stack.frames;
  std::sort(frames.begin(), frames.end(), [](const Frame& a, const Frame& b) { return a.index < b.index; });
  for (const LampFault& fault : session.state.faults) session.warn(fault.message);
  session.result.faults = session.state.faults;
  session.result.dropped = session.feed.dropped();
  measure_saturation(session);
  session.result.stack = std::move(session.state.stack);
  session.result.stack.unknown_keys = finished_keys(session.state);
  return std::move(session.result);
}

}  // namespace

ScanResult capture_stack(const Devices& devices, const Rig& rig, const ScanOptions& options,
                         const ScanProgressCallback& progress) {
  if (!devices.source.describe().live) {
    throw UsageError(
        "a recording does not follow the lamps; read it as a stack, or import it with 'rakelight import "
        "oni'");
  }
  const AllOff on_every_way_out(devices);
  devices.source.start();
  ScanSession session(devices, rig, options, progress);
  FrameKeeper keeper(session);
  session.tell("waiting for the sensor", 0);
  devices.lights.all_off();
  session.set_exposure(session.exposure);
  session.tell("measuring the latency of the lamps", 0.05);
  session.find_first_lag();
  if (!options.resume) meter(session);
  take_sequence(session, keeper);
  retake_what_failed(session, keeper);
  return finish(session, keeper);
}

}  // namespace rakelight
