// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What colour values mean: how a value encodes radiance, and how much of a LED's light leaks into other channels.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

struct CrosstalkFit {
  Eigen::Matrix3d crosstalk;  ///< LightStack::color_crosstalk; every LED leaves 1 in its own channel
  Eigen::Matrix3d deviation;  ///< of each element, over the picture's regions
  int pixels = 0;             ///< used
};

/// From a stack of a white card under the red, the green and the blue lamps alone. Values are decoded by the stack's
/// response; its crosstalk is ignored; dark frames are subtracted. What a LED's absolute strength is cannot be told from
/// the card's reflectance, so each column is divided by its own channel.
/// @throws InputError if a colour is missing, too dark or clipped, or lights another channel more than its own
CrosstalkFit measure_crosstalk(const LightStack& stack);

struct ResponseFit {
  ColorResponse response;
  double gamma = 1;      ///< best exponent, whatever `response` is
  double deviation = 0;  ///< of the exponent, over the picture's regions
  double error = 0;      ///< rms of log radiance that is left, as a share
  int samples = 0;
};

/// From stacks of one scene under the same lamps that differ in exposure_us only. With radiance = value^g, a pixel's
/// g log(value) rises by log(exposure). The named responses are preferred where they fit as well.
/// @throws InputError if exposures are not told, do not differ by a factor of 1.5, or the images do not match
ResponseFit measure_response(const std::vector<LightStack>& sweep);

}  // namespace rakelight
