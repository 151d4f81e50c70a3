// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/image_sums.h"

#include <algorithm>

#include "refine/kernels/image_kernels.h"

namespace rakelight {
namespace {

/// Of one channel.
kernels::PlainTerms plain_terms(const float (&l)[3], float phi, const ChannelSamples& samples) {
  const float least = samples.least(), step = samples.step();
  return {{l[0] * l[0], l[0] * l[1], l[0] * l[2], l[1] * l[1], l[1] * l[2], l[2] * l[2],  // G
           l[0] * phi, l[1] * phi, l[2] * phi, phi * phi,                                 // g, sum phi^2
           l[0] * least, l[1] * least, l[2] * least, phi * least},                        // W, F of code 0
          {l[0] * step, l[1] * step, l[2] * step},
          phi * step,
          step,
          least};
}

}  // namespace

ImageLamps::ImageLamps(const Observations& images, const SurfaceState& state)
    : lamps(tile_lamps(state)), plain(lamps.size()) {
  for (size_t i = 0; i < lamps.size(); ++i)
    for (int c = 0; c < 3; ++c)
      plain[i].channel[c] =
          plain_terms(lamps[i].l[c], lamps[i].phi[c], images.channel(static_cast<int>(i), c));
}

void ImageSums::add_plain(Tile& tile, const TileStretch& stretch) {
  kernels::plain_sums(tile.surface(), lamps_.plain.data(), chosen(lamps_.lamps, tile, stretch.plain),
                      stretch.pixels, plain_, albedo_);
}

void ImageSums::find_albedo(Tile& tile, const TileStretch& stretch) {
  if (!stretch.others.empty())
    kernels::add_albedo_sums(tile.surface(), chosen(lamps_.lamps, tile, stretch.others), stretch.pixels,
                             albedo_);
  kernels::divide_albedo(albedo_, stretch.pixels, tile.surface());
}

void ImageSums::find_tensors(Tile& tile, const TileStretch& stretch, AlbedoRole role) {
  const bool coupled = role == AlbedoRole::follows_normal;
  kernels::plain_tensors(tile.surface(), plain_, stretch.pixels, tensors_);
  if (coupled) kernels::plain_coupling(tile.surface(), plain_, stretch.pixels, coupling_);
  if (!stretch.others.empty())
    kernels::add_tensors(tile.surface(), chosen(lamps_.lamps, tile, stretch.others), stretch.pixels, tensors_,
                         coupled ? &coupling_ : nullptr);
}

}  // namespace rakelight
