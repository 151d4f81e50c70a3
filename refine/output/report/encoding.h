// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Binary data as text that a page can hold.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace rakelight {

/// RFC 4648, padded.
std::string base64(const void* data, std::size_t size);

/// A JPEG as a data: URI. @param picture grey, or R, G, B; 8-bit  @param quality 0 to 100
std::string jpeg_uri(const cv::Mat& picture, int quality);

}  // namespace rakelight
