// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The RGB-D sensors on the USB, asked without their drivers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/known_sensors.h"

namespace rakelight {

/// What came of opening a device.
enum class UsbAccess {
  usable,
  denied,   ///< no permission
  busy,     ///< another program uses it
  gone,     ///< unplugged meanwhile
  trouble,  ///< anything else
};
std::string to_string(UsbAccess access);

struct UsbSensor {
  std::uint16_t vendor = 0, product = 0;
  KnownSensor kind;
  int bus = 0, address = 0;
  std::string port;     ///< where it is plugged in, counted from the root hub: "1.3"
  double megabits = 0;  ///< a second; 0: not known
  UsbAccess access = UsbAccess::usable;
  std::string trouble;  ///< libusb's word where access is trouble

  std::string usb_id() const;  ///< "1d27:0601"
  std::string node() const;    ///< its file, "/dev/bus/usb/002/005"
};

/// Opens each for a moment and changes nothing. @throws std::system_error if the USB cannot be looked at.
std::vector<UsbSensor> find_usb_sensors();

}  // namespace rakelight
