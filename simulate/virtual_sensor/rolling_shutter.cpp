// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/rolling_shutter.h"

namespace rakelight {

std::vector<LampRows> frame_light(const LampTimeline& lamps, const RollingShutter& shutter, double start_us) {
  std::vector<LampRows> light;
  for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp) {
    if (lamps.lit_us(lamp, start_us, start_us + shutter.span_us()) <= 0) continue;
    LampRows rows{lamp, {}};
    rows.lit_us.reserve(static_cast<std::size_t>(shutter.rows));
    for (int row = 0; row < shutter.rows; ++row) {
      const double opens = start_us + row * shutter.readout_us / shutter.rows;
      rows.lit_us.push_back(static_cast<float>(lamps.lit_us(lamp, opens, opens + shutter.exposure_us)));
    }
    light.push_back(std::move(rows));
  }
  return light;
}

}  // namespace rakelight
