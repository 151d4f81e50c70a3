// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which USB devices are RGB-D sensors, and what each needs before OpenNI2 sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace rakelight {

struct KnownSensor {
  std::string model;
  std::string driver;    ///< file of the OpenNI2 driver it needs; empty: no OpenNI2 driver is known
  bool packaged = true;  ///< whether that driver comes with OpenNI2 itself
};

/// Nothing for USB devices that are no sensors.
std::optional<KnownSensor> known_sensor(std::uint16_t vendor, std::uint16_t product);

}  // namespace rakelight
