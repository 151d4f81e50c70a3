// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What each row of a rolling shutter saw of each lamp.
#pragma once

#include <vector>

#include "simulate/virtual_sensor/lamp_timeline.h"

namespace rakelight {

/// Row r of a frame that starts at t is open in [t + r * readout / rows, + exposure).
struct RollingShutter {
  int rows = 480;
  double exposure_us = 8000;
  double readout_us = 30000;

  /// From the opening of the first row to the closing of the last.
  double span_us() const { return exposure_us + readout_us * (rows - 1) / rows; }
};

/// One lamp's light in one frame.
struct LampRows {
  std::size_t lamp = 0;
  std::vector<float> lit_us;  ///< one a row: time for which it was open and lit, weighted by brightness
};

/// The lamps that gave any light to the frame that starts at `start_us`.
std::vector<LampRows> frame_light(const LampTimeline& lamps, const RollingShutter& shutter, double start_us);

}  // namespace rakelight
