// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The virtual rig as devices: what its driver is told, and its lamps as a bank of lines. The sensor itself is opened like any
// other (openni_source.h).
#pragma once

#include <memory>
#include <string>

#include "capture/rig.h"
#include "lights/lights.h"

namespace rakelight {

/// The virtual part of a rig as the driver's JSON (simulate/virtual_sensor/setup.h). `rig.virtual_rig` must be set.
std::string virtual_sensor_text(const Rig& rig);

/// Lines that switch the virtual lamps, in the order of `rig.lamps`. They work as long as the bank lives, whatever becomes of
/// the sensor. @throws std::system_error if the virtual sensor's driver is not found, or refuses the rig.
std::unique_ptr<LineBank> open_virtual_bank(const Rig& rig);

/// What the virtual sensor's colour camera really has before it, on the grid of its images. While the sensor or its lamps are
/// open this costs no new rendering. @throws std::system_error
GroundTruth virtual_truth(const Rig& rig);

}  // namespace rakelight
