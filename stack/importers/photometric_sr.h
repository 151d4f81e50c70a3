// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Source folders of the public photometric depth super-resolution data sets.
//
//     RGB/I_1.png ...     one image a lamp, 8- or 16-bit RGB
//     Depth/z0_1.png ...  16-bit, mm = min + raw * (max - min) / 65535, 0 = no reading; any number of them
//     mask.png            255 = object
//     K.txt               three comma-separated rows of the colour camera's matrix, then `scale,min,max`,
//                         where colour size = scale x depth size and min, max are in mm
//     response.txt        optional: linear, srgb or a gamma; without it values are taken as linear
#pragma once

#include <filesystem>

#include "stack/stack.h"

namespace rakelight {

/// Whether the folder has this layout (RGB/ and K.txt).
bool is_photometric_sr(const std::filesystem::path& folder);

/// Images pair with depth by their number; both are in natural order (I_2 before I_10).
/// @param colors on_disk: all but the first colour image, which tells their size, are left there
/// @throws InputError naming the file, the fault and the cure.
LightStack import_photometric_sr(const std::filesystem::path& folder, Colors colors = Colors::in_memory);

}  // namespace rakelight
