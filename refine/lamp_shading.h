// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shading of one image over a run of pixels: S_c = max(0, l_c . n) + phi_c and its kin (refine/lamp.h), planar, so that the
// steps that read all images (albedo, weights, noise) share one tight loop.
#pragma once

#include <array>

#include "refine/pixel_blocks.h"
#include "refine/surface_state.h"

namespace rakelight {

/// S[c][p - begin] for a run of at most kPixelBlock pixels.
struct ShadingBlock {
  std::array<std::array<float, kPixelBlock>, 3> S;
};

/// Fills `block` with the state's shading under `lamp` at pixels [begin, end), end - begin <= kPixelBlock.
void shade(const Lamp& lamp, const SurfaceState& state, int begin, int end, ShadingBlock& block);

}  // namespace rakelight
