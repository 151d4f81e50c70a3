// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether what a stack holds can be worked with at all. Whether the lamps suffice is the method's question.
#pragma once

#include "stack/stack.h"

namespace rakelight {

/// @throws InputError (subject: the stack's origin) when image sizes do not match the cameras or each other; there is
/// no colour, no depth or only zero depth; the mask is empty, nearly so, or where no depth reaches; or every lit image
/// is black or saturated on the object.
void check_stack(const LightStack& stack);

/// Share of the mask's pixels (the image's without one) that are saturated in a frame, 0 to 1.
double saturated_share(const LightStack& stack, const Frame& frame);

/// Whether a colour image is black on the object: no code above sensor noise.
bool is_black(const LightStack& stack, const Frame& frame);

/// Depth pixels with a reading in any frame that project into the mask (all with a reading, without one).
int masked_depth_count(const LightStack& stack);

}  // namespace rakelight
