// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PNG's row filters undone. PNG specification (ISO/IEC 15948), section 9.2.
#pragma once

#include <cstddef>

namespace rakelight {

/// One row as it was before filtering.
/// @param filtered the filter's number, then `bytes` bytes  @param above the row before, undone; null for the first
/// @param pixel_bytes 1, 2, 3 or 6  @param row takes `bytes` bytes  @return false if no filter has that number
bool undo_png_filter(const unsigned char* filtered, const unsigned char* above, std::size_t bytes,
                     int pixel_bytes, unsigned char* row);

}  // namespace rakelight
