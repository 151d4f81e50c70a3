// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the vector kernels work on: a tile, a run of pixels small enough for the cache, with everything planar.
//
// The kernels (refine/kernels/*.cpp) are compiled once for each instruction set and chosen at run time, so that one
// program runs on any processor. They read whole vectors: arrays of a tile are kTilePixels long, whatever its count.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rakelight::kernels {

constexpr int kTilePixels = 512;

/// A tile is judged by pieces: which of its images are plain (refine/kernels/plain_kernels.h).
constexpr int kPiecePixels = 64;

/// One number a pixel of a tile.
struct alignas(64) TileRow {
  float at[kTilePixels];
};

/// Shape and albedo of a tile.
struct TileSurface {
  TileRow normal[3];  ///< unit, camera frame
  TileRow offset[3];  ///< metres from the object's centre (LampScene); near lamps only
  TileRow albedo[3];  ///< a channel
};

enum class LightKind { far, near, second_order };

/// A lamp as refine/lamp.h has it, without matrices.
struct TileLamp {
  LightKind kind = LightKind::far;
  float l[3][3] = {};       ///< far: [channel] light vector
  float phi[3] = {};        ///< [channel] ambient share
  float Q[3][6] = {};       ///< second order: [channel] xx, yy, zz, xy, xz, yz
  float direction[3] = {};  ///< near
  float inverse_distance = 0, lobe_exponent = 1;
  float strength[3] = {};  ///< near: [channel]
  float least = 0;         ///< of l.n: 0 with attached shadows, else -infinity
};

/// Samples of one image in a tile; 16-bit codes, radiance = least + step * code, kUnusable where none can be used.
struct TileImage {
  static constexpr std::uint16_t kUnusable = 0xFFFF;

  const std::uint16_t* codes[3] = {};  ///< [channel]
  float step[3] = {}, least[3] = {};
  const float* weight = nullptr;  ///< trust in the pixel's sample
  std::ptrdiff_t next = 0;        ///< from here to the samples that will be asked for next
};

/// Pixels [begin, end) of a tile, whole pieces.
struct Stretch {
  int begin = 0, end = kTilePixels;
};

/// Some of a tile's images, and the lamps that made them: lamps[which[k]] made images[which[k]].
struct ImageChoice {
  const TileLamp* lamps;
  const TileImage* images;
  const int* which;
  int count;
};

/// sum w S I and sum w S S a channel.
struct AlbedoSums {
  TileRow SI[3], SS[3];
};

/// e(n) = n' G n - 2 h' n + e0 a pixel (refine/steps/photometric_tensor.h).
struct TileTensors {
  TileRow xx, xy, xz, yy, yz, zz, hx, hy, hz, e0;
};

/// How albedo and normal hang together, a channel: sum w S S, and sum w S l over the lit samples.
struct AlbedoCoupling {
  TileRow SS[3], Sl[3][3];  ///< [channel], [channel][x, y, z]
};

}  // namespace rakelight::kernels
