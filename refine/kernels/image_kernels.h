// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sums over images that multi-light refinement is made of, of any lamps and weights, over a stretch of a tile. A vector of
// pixels goes through all images before the next, so that its sums stay in registers.
#pragma once

#include "refine/kernels/tile.h"

namespace rakelight::kernels {

/// Splits `count` interleaved triples (at most kTilePixels) into rows.
void deinterleave3(const float* triples, int count, TileRow (&rows)[3]);

/// The other way round.
void interleave3(const TileRow (&rows)[3], int count, float* triples);

/// Normal equations of one image's light vectors, a channel each: sums of w rho^2 h h' (upper triangle by rows) and
/// w rho I h, h = (n, 1), n = 0 in the attached shadow of `lamp`.
struct LightSums {
  float A[3][10];
  float b[3][4];
};
void light_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, Stretch stretch,
                LightSums& sums);

/// Adds w S I and w S S of the images to the albedo's sums.
void add_albedo_sums(const TileSurface& surface, const ImageChoice& choice, Stretch stretch,
                     AlbedoSums& sums);

/// rho = SI / SS, not below 0, where SS says anything.
void divide_albedo(const AlbedoSums& sums, Stretch stretch, TileSurface& surface);

/// Adds the images' shares of e(n). @param coupling what they tie albedo and normal by is added to it; nullptr: not asked for
void add_tensors(const TileSurface& surface, const ImageChoice& choice, Stretch stretch, TileTensors& sums,
                 AlbedoCoupling* coupling);

/// The same under new Cauchy weights, which are written to weights[choice.which[k]]: 1 / (1 + r^2 / scale^2), r^2 the mean over the
/// sample's usable channels; 0 without any. What `choice` holds of weights is not read.
void reweigh_and_add_tensors(const TileSurface& surface, const ImageChoice& choice, float scale,
                             Stretch stretch, float* const* weights, TileTensors& sums,
                             AlbedoCoupling* coupling);

/// Lets the albedo follow the normal n: e(n + d) -= d' K d with K = sum_c rho^2 (sum w S l)(sum w S l)' / sum w S S.
void eliminate_albedo(const TileSurface& surface, const AlbedoCoupling& coupling, TileTensors& tensors);

}  // namespace rakelight::kernels
