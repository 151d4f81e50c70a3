// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is plugged in, what is wrong with it, and what cures it.
//
//     const Hardware hardware = survey_hardware();
//     const std::vector<Finding> findings = diagnose(hardware, rig);
#pragma once

#include <string>
#include <vector>

#include "capture/open_files.h"
#include "capture/openni_install.h"
#include "capture/rig.h"
#include "capture/usb_sensors.h"
#include "lights/gpio_chips.h"

namespace rakelight {

struct Hardware {
  std::vector<UsbSensor> sensors;
  std::vector<std::vector<Process>> sensor_users;  ///< [sensor] who has it open
  OpenniInstall openni;
  std::vector<GpioChip> chips;
  std::vector<Process> line_holders;  ///< processes that have requested GPIO lines of any chip
};

/// Looks; changes nothing. @throws std::system_error if the USB cannot be looked at at all.
Hardware survey_hardware();

struct Finding {
  enum class Level {
    good,
    note,     ///< worth knowing; no scan fails for it
    problem,  ///< a scan would fail
  };
  Level level = Level::good;
  std::string subject;  ///< "sensor 1d27:0601", "lamp white-3", ...
  std::string what;
  std::string cure;  ///< empty for what is good
};
std::string to_string(Finding::Level level);

/// What to say about the hardware. @param rig what should be there; null: whatever is
std::vector<Finding> diagnose(const Hardware& hardware, const Rig* rig);

/// The line of a udev rule that lets people at the machine use every USB device of a vendor.
std::string udev_rule(std::uint16_t vendor);

}  // namespace rakelight
