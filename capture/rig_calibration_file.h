// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of a rig file that calibration writes: `[calibration]`, lamp positions, timing.
#pragma once

#include <string>

#include "capture/rig.h"
#include "capture/toml_reader.h"

namespace rakelight {

/// `[calibration]` of a rig file; empty where there is none. @throws InputError with the place of the fault.
RigCalibration read_calibration(TomlReader& file);

/// The text of a rig file with what calibration measures replaced by `rig`'s values, everything else as it was.
/// @param file for messages @throws InputError where that cannot be done.
std::string with_calibration(const std::string& text, const Rig& rig, const std::string& file);

}  // namespace rakelight
