// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scan that can be refined in a blink: a bump on a plane under eight far lamps.
#pragma once

#include "stack/stack.h"

namespace rakelight::test {

/// Colour 96 x 72 (16-bit, linear), depth 48 x 36 at about 0.6 m with noise; a mask of colour's size, a truth.
LightStack bump_stack();
GroundTruth bump_truth();

}  // namespace rakelight::test
