// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures as JPEG, in memory.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace rakelight {

/// @param picture 8 bits, grey or R, G, B  @param quality 1 to 100  @throws IoError
std::vector<unsigned char> jpeg_bytes(const cv::Mat& picture, int quality);

}  // namespace rakelight
