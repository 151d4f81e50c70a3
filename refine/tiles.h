// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between the refinement's state and the vector kernels (refine/kernels/tile.h): a tile's shape and albedo are copied to
// planar rows once for all images; images and weights are read where they lie, except in the last tile, which is filled up.
#pragma once

#include "refine/kernels/tile.h"
#include "refine/observations.h"
#include "refine/pixel_blocks.h"
#include "refine/surface_state.h"

namespace rakelight {

/// A lamp in the kernels' terms, under the state's scene and its rule for attached shadows.
kernels::TileLamp tile_lamp(const Lamp& lamp, const SurfaceState& state);

/// All lamps of the state.
std::vector<kernels::TileLamp> tile_lamps(const SurfaceState& state);

/// Pixels [begin, begin + count) of a state and its images.
class Tile {
 public:
  Tile(const Observations& images, const SurfaceState& state);

  /// @param count at most kernels::kTilePixels
  void move_to(int begin, int count);

  int begin() const { return begin_; }
  int count() const { return count_; }
  kernels::TileSurface& surface() { return surface_; }

  /// Samples of image i with the state's weights, until the next call.
  const kernels::TileImage& image(int i);

 private:
  const Observations& images_;
  const SurfaceState& state_;
  bool any_near_;  ///< only near lamps ask where the pixels are
  int begin_ = 0, count_ = 0;
  kernels::TileSurface surface_;
  kernels::TileImage image_;
  std::uint16_t codes_[3][kernels::kTilePixels];  ///< the filled-up samples of the last tile
  kernels::TileRow weight_;
};

/// Calls body(tile) for every tile, in parallel; tiles do not depend on the number of threads.
template <class Body>
void for_each_tile(const Observations& images, const SurfaceState& state, const Body& body) {
  for_each_block(images.pixels, [&](int begin, int end) {
    Tile tile(images, state);
    for (int p = begin; p < end; p += kernels::kTilePixels) {
      tile.move_to(p, std::min(kernels::kTilePixels, end - p));
      body(tile);
    }
  });
}

}  // namespace rakelight
