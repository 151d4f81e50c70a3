// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo.h"

#include "refine/kernels/image_kernels.h"
#include "refine/tiles.h"

namespace rakelight {

Eigen::Matrix3Xf estimate_albedo(const Observations& images, const SurfaceState& state) {
  Eigen::Matrix3Xf albedo = state.albedo;
  const std::vector<kernels::TileLamp> lamps = tile_lamps(state);
  for_each_tile(images, state, [&](Tile& tile) {
    kernels::TileRow SI[3] = {}, SS[3] = {};
    for (int i = 0; i < images.images; ++i)
      kernels::add_albedo_sums(tile.surface(), lamps[static_cast<size_t>(i)], tile.image(i), SI, SS);
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < tile.count(); ++k)
        if (SS[c].at[k] > 1e-8f) albedo(c, tile.begin() + k) = std::max(0.0f, SI[c].at[k] / SS[c].at[k]);
  });
  return albedo;
}

void normalize_albedo(SurfaceState& state) {
  for (int c = 0; c < 3; ++c) {
    const float mean = static_cast<float>(state.albedo.row(c).cast<double>().mean());
    if (!(mean > 0.0f)) continue;
    state.albedo.row(c) /= mean;
    for (Lamp& lamp : state.lamps) {
      lamp.l.row(c) *= mean;
      lamp.Q[static_cast<size_t>(c)] *= mean;
      lamp.phi[c] *= mean;
      lamp.strength[c] *= mean;
    }
  }
}

}  // namespace rakelight
