// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a stack holds, in numbers and warnings a person can act on.
#pragma once

#include <string>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

struct StackSummary {
  int color_images = 0, dark_images = 0, depth_images = 0;
  int color_bits = 0;                    ///< 8 or 16; 0 without colour
  int object_pixels = 0;                 ///< of the mask; 0 without one
  double depth_coverage = 0;             ///< share of the object that has depth in any frame, 0 to 1
  double nearest_m = 0, farthest_m = 0;  ///< of depth readings, whole image
  double saturated_mean = 0, saturated_worst = 0;  ///< share of the object's pixels, over lit images
  std::string worst_light;                         ///< lamp of saturated_worst
  int lit_checked = 0, lit_matching = 0;           ///< frames with a lit check, and those that agree
  std::vector<std::string> warnings;               ///< one sentence each
};

StackSummary summarise(const LightStack& stack);

}  // namespace rakelight
