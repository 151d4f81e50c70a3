// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The same sums for plain images: under a far lamp of first order, with every sample of the stretch usable and of weight 1,
// and no pixel in the attached shadow. There S = l.n + phi, and the sums over images that do not hold a sample
//
//     G = sum l l',  g = sum l phi,  sum phi^2
//
// are the same at every pixel. What is left to be done a sample is W = sum l I, F = sum phi I and E = sum I^2 of a channel, and
//
//     sum S I = n'W + F,   sum S^2 = n'G n + 2 g'n + sum phi^2
//     G += rho^2 G,   h += rho (W - rho g),   e0 += rho^2 sum phi^2 - 2 rho F + E      (refine/steps/photometric_tensor.h)
//     sum S l = G n + g
#pragma once

#include "refine/kernels/tile.h"

namespace rakelight::kernels {

/// What one lamp adds in one channel, for samples least + step * code.
struct alignas(64) PlainTerms {
  enum Constant { xx, xy, xz, yy, yz, zz, gx, gy, gz, phi2, Wx, Wy, Wz, F, kConstants = 16 };

  float constant[kConstants];  ///< G, g, sum phi^2; W and F of code 0
  float step_l[3], step_phi;   ///< W and F a code
  float step, least;
};

struct PlainLamp {
  PlainTerms channel[3];
};

/// The sums over the plain images.
struct PlainSums {
  TileRow W[3][3];                                        ///< [channel][x, y, z]
  TileRow F[3];                                           ///< [channel]
  TileRow E;                                              ///< over the channels
  alignas(64) float constant[3][PlainTerms::kConstants];  ///< [channel]
};

/// Sums over the images which[0..count), and the albedo's sums of them. Overwrites. @param lamps [image]
void plain_sums(const TileSurface& surface, const PlainLamp* lamps, const ImageChoice& choice,
                Stretch stretch, PlainSums& sums, AlbedoSums& albedo);

/// The images' share of e(n), under the surface's albedo. Overwrites.
void plain_tensors(const TileSurface& surface, const PlainSums& sums, Stretch stretch, TileTensors& tensors);

/// How the images tie albedo to normal. Overwrites.
void plain_coupling(const TileSurface& surface, const PlainSums& sums, Stretch stretch,
                    AlbedoCoupling& coupling);

/// What the lights' normal equations (LightSums) of all plain images share.
struct PlainLights {
  TileRow rho_n[3][3];  ///< [channel][x, y, z]
  float A[3][10];       ///< sum rho^2 h h'
  float rho_h[3][4];    ///< sum rho h: b of samples of radiance 1
};
void plain_lights(const TileSurface& surface, Stretch stretch, PlainLights& lights);

/// b of the images which[0..count). @param b [image]
void plain_light_rhs(const TileSurface& surface, const PlainLights& lights, const ImageChoice& choice,
                     Stretch stretch, float (*b)[3][4]);

/// Least and most of each component of the normals.
struct NormalBounds {
  float least[3], most[3];
};

/// In each piece.
void normal_bounds(const TileSurface& surface, NormalBounds (&bounds)[kTilePixels / kPiecePixels]);

}  // namespace rakelight::kernels
