// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a TIFF file claims, read before any pixel is allocated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace rakelight {

/// The first image of a TIFF file.
struct TiffHeader {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 1;
  bool is_float32 = false;
};

/// @param file named in messages  @throws InputError if this is no classic TIFF, its directory or pixels lie outside
/// the file, or it is larger than the bounds of png_header.h.
TiffHeader parse_tiff_header(const unsigned char* data, std::size_t size, const std::string& file);

}  // namespace rakelight
