// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Albedo and photometric tensors of a tile: the sums of its plain images and of the others, put together.
#pragma once

#include <vector>

#include "refine/kernels/image_kernels.h"
#include "refine/kernels/plain_kernels.h"
#include "refine/steps/photometric_tensor.h"
#include "refine/tiles.h"

namespace rakelight {

/// The lamps of a state as the kernels of all its tiles take them.
struct ImageLamps {
  ImageLamps(const Observations& images, const SurfaceState& state);

  std::vector<kernels::TileLamp> lamps;   ///< [image]
  std::vector<kernels::PlainLamp> plain;  ///< [image]
};

/// What is summed in one tile. Each call does a stretch; they build on each other in the order given here.
class ImageSums {
 public:
  explicit ImageSums(const ImageLamps& lamps) : lamps_(lamps) {}

  /// Sums over the plain images.
  void add_plain(Tile& tile, const TileStretch& stretch);

  /// Puts the albedo into the tile's surface.
  void find_albedo(Tile& tile, const TileStretch& stretch);

  /// The tensors under the surface's albedo, and, if it is to follow the normal, what ties it to that.
  void find_tensors(Tile& tile, const TileStretch& stretch, AlbedoRole role);

  /// Lets the albedo follow the normal in the whole tile. Once, and last.
  void eliminate_albedo(Tile& tile) { kernels::eliminate_albedo(tile.surface(), coupling_, tensors_); }

  const kernels::TileTensors& tensors() const { return tensors_; }

 private:
  const ImageLamps& lamps_;
  kernels::PlainSums plain_;
  kernels::AlbedoSums albedo_;
  kernels::TileTensors tensors_;
  kernels::AlbedoCoupling coupling_;
};

}  // namespace rakelight
