// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The four sums over images that multi-light refinement is made of, for one image and one tile.
#pragma once

#include "refine/kernels/tile.h"

namespace rakelight::kernels {

/// Splits `count` interleaved triples (at most kTilePixels) into rows.
void deinterleave3(const float* triples, int count, TileRow (&rows)[3]);

/// Normal equations of one image's light vectors, a channel each: sums of w rho^2 h h' (upper triangle by rows) and
/// w rho I h, h = (n, 1), n = 0 in the attached shadow of `lamp`. Pixels from count on do not count.
struct LightSums {
  float A[3][10];
  float b[3][4];
};
void light_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, int count,
                LightSums& sums);

/// Adds w S I and w S S of each channel to the albedo's sums.
void add_albedo_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                     TileRow (&SI)[3], TileRow (&SS)[3]);

/// Cauchy weight of each pixel's sample, 1 / (1 + r^2 / scale^2), r^2 the mean over the usable channels; 0 without any.
void cauchy_weight(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, float scale,
                   TileRow& weight);

/// Adds the image's share of e(n).
void add_tensors(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, TileTensors& sums);

}  // namespace rakelight::kernels
