// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which image of a stack the single-image methods use.
#pragma once

#include <string>

#include "refine/observations.h"

namespace rakelight {

/// One image and where it comes from.
struct SelectedImage {
  Observations image;       ///< exactly one image
  std::string explanation;  ///< e.g. "frame 3 (lamp left) was used"
};

/// Any one image: frame `frame`, or with frame = -1 the first lit one. @throws UsageError when there is no such frame.
SelectedImage select_any_image(const Observations& images, int frame);

/// The image under red, green and blue lamps: `frame`, or the first lit by all three. The only image of a stack is
/// taken to be one. Else one image each under a red, a green and a blue lamp are put together.
/// @throws InputError naming the method that fits when the stack has none.
SelectedImage select_colored_image(const LightStack& stack, const Observations& images, int frame);

}  // namespace rakelight
