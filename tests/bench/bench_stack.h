// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scan of any size in memory: a wavy surface that fills the picture, far white lamps on a ring, 8-bit images, noisy depth.
#pragma once

#include "stack/stack.h"

namespace rakelight::bench {

/// @param width, height pixels of colour and depth alike  @param images lit frames
LightStack wavy_stack(int width, int height, int images);

}  // namespace rakelight::bench
