// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rig files: TOML by people, with comments; what calibration finds is written into them without touching the rest
// (docs/rig-file.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "capture/rig.h"

namespace rakelight {

inline constexpr std::uint64_t kMaxRigFileBytes = 1 << 20;

/// Reads and checks a rig file; keys it does not set have the defaults of capture/rig.h.
/// @throws InputError `file:line:column: what is wrong; what to do`, also for keys nobody knows; IoError.
Rig read_rig(const std::filesystem::path& file);

/// As read_rig. @param file for messages
Rig parse_rig(const std::string& text, const std::string& file);

/// Writes what calibration measures into an existing rig file: `[calibration]`, the lamps' `position_m` and the
/// timing of `[sensor]`, as far as they differ from what the file says. Every other byte stays, comments included.
/// The file is the old one or the new one at any moment.
/// @param rig as read from this file (same lamps in the same order), then changed
/// @throws InputError if the file cannot be read or is of a layout this cannot write into; BusyError; IoError.
void store_calibration(const Rig& rig, const std::filesystem::path& file);

}  // namespace rakelight
