// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Between the refinement's state and the vector kernels (refine/kernels/tile.h): a tile's shape and albedo are copied to
// planar rows once for all images; images and weights are read where they lie, except the last tile's weights, which are filled up.
#pragma once

#include <vector>

#include "refine/kernels/tile.h"
#include "refine/observations.h"
#include "refine/pixel_blocks.h"
#include "refine/surface_state.h"

namespace rakelight {

/// A lamp in the kernels' terms, under the state's scene and its rule for attached shadows.
kernels::TileLamp tile_lamp(const Lamp& lamp, const SurfaceState& state);

/// All lamps of the state.
std::vector<kernels::TileLamp> tile_lamps(const SurfaceState& state);

/// Part of a tile in which the same images are plain (refine/kernels/plain_kernels.h).
struct TileStretch {
  kernels::Stretch pixels;
  std::vector<int> plain, others;  ///< images
};

/// Pixels [begin, begin + count) of a state and its images.
class Tile {
 public:
  /// @param step to the tile after
  Tile(const Observations& images, const SurfaceState& state, int step = kernels::kTilePixels);

  /// @param begin a multiple of kernels::kTilePixels  @param count at most kernels::kTilePixels
  void move_to(int begin, int count);

  int begin() const { return begin_; }
  int count() const { return count_; }
  kernels::TileSurface& surface() { return surface_; }

  /// Copies the surface's albedo into all pixels', 3 x pixels.
  void store_albedo(Eigen::Matrix3Xf& albedo) const;

  /// [image] Samples with the state's weights, until the next move.
  const kernels::TileImage* images() const { return tile_images_.data(); }
  const kernels::TileImage& image(int i) const { return tile_images_[static_cast<size_t>(i)]; }

  /// The tile from its first pixel to its last, each stretch as long as can be, until the next call. @param lamps [image]
  const std::vector<TileStretch>& stretches(const std::vector<kernels::TileLamp>& lamps);

  /// All images.
  kernels::ImageChoice all(const std::vector<kernels::TileLamp>& lamps) const;

 private:
  class PlainSearch;

  void fill_up();

  const Observations& images_;
  const SurfaceState& state_;
  bool any_near_;  ///< only near lamps ask where the pixels are
  int begin_ = 0, count_ = 0;
  kernels::TileSurface surface_;
  std::vector<int> every_image_;
  std::vector<kernels::TileImage> tile_images_;
  std::vector<kernels::TileRow> weights_;  ///< [image] of the last tile, filled up
  std::vector<TileStretch> stretches_;
};

inline kernels::ImageChoice chosen(const std::vector<kernels::TileLamp>& lamps, const Tile& tile,
                                   const std::vector<int>& which) {
  return {lamps.data(), tile.images(), which.data(), static_cast<int>(which.size())};
}

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
