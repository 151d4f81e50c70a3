// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an error bar asks of the images (refine/steps/residual_draws.h), for one image and one tile.
#pragma once

#include "refine/kernels/tile.h"

namespace rakelight::kernels {

constexpr int kDraws = 8;  ///< at a time

/// What images and albedo add up to, a pixel: r = I - rho S, w the sample's weight, l 0 in the attached shadow.
struct TileDraws {
  TileRow q[3][kDraws];   ///< [axis][draw] sum factor w rho l r
  TileRow Sr[3][kDraws];  ///< [channel][draw] sum factor w S r
  TileRow by_rho[3][3];   ///< [channel][axis] sum w l (r - rho S), the change by rho
  TileRow SS[3];          ///< [channel] sum w S^2
};

/// Adds the image's share. @param factor of each draw
void add_residual_draws(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                        const float (&factor)[kDraws], TileDraws& sums);

/// Adds the weight of each pixel that the lamp shines on.
void add_lit_weights(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, TileRow& lit);

}  // namespace rakelight::kernels
