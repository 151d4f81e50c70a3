// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From encoded colour values to linear radiance.
#pragma once

#include <string>

#include "stack/stack.h"

namespace rakelight {

/// `linear`, `srgb` or a positive number GAMMA (radiance = value^GAMMA). @throws UsageError otherwise.
ColorResponse parse_color_response(const std::string& text);
std::string to_string(const ColorResponse& response);

/// Linear radiance in [0, 1] of an encoded value in [0, 1], and back.
double decode(const ColorResponse& response, double value);
double encode(const ColorResponse& response, double radiance);

/// The frame's colour as linear RGB in [0, 1], height x width, crosstalk undone (which may leave [0, 1] slightly).
cv::Mat3f linear_color(const LightStack& stack, const Frame& frame);

/// 255 in each channel that is clipped at the top of its encoding (>= 254 of 255, or >= 65279 of 65535).
cv::Mat3b saturated_channels(const Frame& frame);

/// 255 where any channel is.
cv::Mat1b saturated(const Frame& frame);

}  // namespace rakelight
