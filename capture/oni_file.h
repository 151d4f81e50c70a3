// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenNI2 recordings (.oni), for exchange with other tools. They hold less than a stack does; our own recording is the stack.
//
// What a stack loses on the way out and in: lamps and which of them lit which frame, mask, truth; principal point, distortion
// and T_color_depth (only fields of view are kept); colour response, crosstalk, white balance, exposure; the low byte of
// 16-bit colour; depth finer than 0.1 mm; gaps in the frame numbers, host times, and the offset between the streams' clocks.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

struct OniImportOptions {
  /// Which lamp lit frame k: an id, or "dark". Empty: every frame is its own lamp, "frame-0000" and so on, as with a lamp
  /// moved by hand. Frames beyond the list are left out.
  std::vector<std::string> lights;
  int every = 1;  ///< take every n-th frame
};

/// Colour and depth frames in pairs, in the order of the recording.
/// @throws InputError for a file that is no recording of colour and depth, or is shorter than the list of lights
LightStack import_oni(const std::filesystem::path& file, const OniImportOptions& options);

/// Writes the frames that have both colour and depth. The library's recorder does it, fed by the driver of the virtual sensor.
/// @throws InputError if no frame has both; IoError; std::system_error without that driver
void export_oni(const LightStack& stack, const std::filesystem::path& file);

}  // namespace rakelight
