// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scan: sensor and lamps to a light stack. Read this header first.
//
//     Devices devices{*open_frame_source(rig), *open_lights(rig), monotonic_clock()};
//     ScanResult scan = capture_stack(devices, rig, options);
//     write_stack(scan.stack, folder);
//
// Dark first and last, every lamp, the colour shot. Frames are gated by time (frame_gate.h) and proven by picture
// (lit_check.h); what fails is taken again. Exposure is metered over all lamps first, and locked.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/frame_source.h"
#include "capture/host_clock.h"
#include "capture/lamp_faults.h"
#include "capture/metering.h"
#include "capture/rig.h"
#include "capture/scan_state.h"
#include "lights/lights.h"
#include "stack/stack.h"

namespace rakelight {

/// What a scan works with. The lamps of `lights` are those of the rig.
struct Devices {
  FrameSource& source;
  Lights& lights;
  HostClock& clock;
};

struct ScanOptions {
  std::optional<int> repeats;    ///< images a lamp; empty: the rig's
  std::optional<bool> rgb_shot;  ///< the colour shot; empty: the rig's
  bool meter = true;             ///< find the exposure; otherwise the rig's is taken as it is
  MeteringLimits metering;
  int max_retakes = 4;              ///< passes over what has failed
  int depth_frames = 2;             ///< kept an image
  double margin_us = 500;           ///< of the gate, for clocks and the measured lag
  std::optional<ScanState> resume;  ///< go on with this
  /// Called for each frame that is kept, as it comes. Must not take long.
  std::function<void(const ScanState&, const Frame&)> on_frame;
};

struct ScanProgress {
  std::string stage;
  double fraction_done = 0;
};
/// Return false to stop.
using ScanProgressCallback = std::function<bool(const ScanProgress&)>;

struct ScanResult {
  LightStack stack;
  std::vector<LampFault> faults;
  std::vector<std::string> warnings;  ///< one sentence each
  double sensor_time_us = 0;  ///< first row of the first frame to last row of the last, without retakes
  int retaken = 0;            ///< frames that were taken again
  int dropped = 0;            ///< frames that never came
  double lag_us = 0;          ///< write to picture
  double saturated = 0;       ///< share of the object's area under the lamp that saturates most
  int metering_rounds = 0;
};

/// Runs the light sequence. All lamps are off and the source is stopped when this returns or throws; what had been kept by
/// then went to options.on_frame.
/// @throws SensorLost; DeviceError if no lamp changes the picture; std::system_error from the lamps; Cancelled;
///         UsageError if rig and options do not fit each other or what is resumed
ScanResult capture_stack(const Devices& devices, const Rig& rig, const ScanOptions& options,
                         const ScanProgressCallback& progress = {});

}  // namespace rakelight
