// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between PNG's bytes and pixels, by libspng.
#pragma once

#include <opencv2/core.hpp>

#include "stack/checked_file.h"
#include "stack/png_header.h"

namespace rakelight {

/// Whether one colour of an image without alpha stands for none (tRNS).
bool png_has_transparency(const Bytes& bytes);

/// Pixels of a PNG whose bytes are whole (check_png_bytes), as the file has them: one channel or R, G, B, 8 or 16 bits.
/// @return empty where it cannot be decoded, or is of another kind: other bit depths, a palette, alpha
cv::Mat png_pixels(const Bytes& bytes, const PngHeader& header);

/// A PNG of any kind as R, G, B, A, in 16 bits where it has 16, else in 8. @return empty where it cannot be decoded
cv::Mat png_rgba(const Bytes& bytes, const PngHeader& header);

/// @param image 8- or 16-bit, one channel or R, G, B  @return empty where the image cannot be a PNG
Bytes png_bytes(const cv::Mat& image);

}  // namespace rakelight
