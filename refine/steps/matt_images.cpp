// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/matt_images.h"

#include "refine/pixel_blocks.h"

namespace rakelight {

void take_off_highlights(const Observations& seen, const SurfaceState& state, const Gloss& gloss,
                         Observations& matt) {
  const auto pixels = static_cast<size_t>(seen.pixels);
  for_each_block(seen.pixels, [&](int begin, int end) {
    for (int i = 0; i < seen.images; ++i) {
      const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
      float* radiance = matt.radiance.data() + 3 * static_cast<size_t>(i) * pixels;
      for (int p = begin; p < end; ++p) {
        const auto share = static_cast<float>(
            highlight_lobes(lamp, state.points.col(p), state.normals.col(p), state.scene).dot(gloss));
        for (int c = 0; c < 3; ++c)
          radiance[static_cast<size_t>(c) * pixels + static_cast<size_t>(p)] =
              seen.channel(i, c)[p] - share * lamp.strength[c];
      }
    }
  });
}

}  // namespace rakelight
