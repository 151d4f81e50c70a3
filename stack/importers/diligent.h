// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Source folders of the DiLiGenT photometric stereo benchmark (Shi et al., PAMI 2019).
//
//     filenames.txt          one image a line, linear, 8- or 16-bit RGB
//     light_directions.txt   x y z a line, towards the lamp; x right, y up, z to the camera
//     light_intensities.txt  r g b a line
//     mask.png               255 = object
//     K.txt                  optional: three rows of the camera's matrix
#pragma once

#include <filesystem>

#include "stack/stack.h"

namespace rakelight {

/// Whether the folder has this layout (filenames.txt and light_directions.txt).
bool is_diligent(const std::filesystem::path& folder);

/// Images come as 16 bit, each divided by its lamp's intensity and times the least intensity of all, so that lamps
/// compare and nothing clips; codes that were saturated stay so. There is no depth. Lamp directions are kept as the
/// manifest's `direction_to_lamp` (unit, camera coordinates: x right, y down, z forward). Without K.txt the camera
/// is the benchmark's (fx 3772.1, fy 3759.0) with its principal point at the image's centre; sensor.name says so.
/// @throws InputError naming the file, the fault and the cure.
LightStack import_diligent(const std::filesystem::path& folder);

}  // namespace rakelight
