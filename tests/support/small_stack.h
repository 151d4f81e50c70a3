// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A light stack of a few pixels with every field filled, and a truth for it.
#pragma once

#include "stack/stack.h"

namespace rakelight::test {

/// Four lamps and a dark frame; colour 24 x 16, depth 12 x 8 in four of the frames; a mask of colour's size.
/// Stacks of different `generation` differ in every image and in `created`.
/// @param bits 8 or 16, of colour
LightStack small_stack(int bits = 16, int generation = 0);

/// Truth on the colour grid of small_stack.
GroundTruth small_truth();

/// EXPECTs that two stacks are the same in every field and pixel (`origin` aside).
void expect_same(const LightStack& a, const LightStack& b);

/// Whether two images are the same in type, size and every pixel.
bool same_pixels(const cv::Mat& a, const cv::Mat& b);

}  // namespace rakelight::test
