// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/matt_images.h"

#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

void take_off_highlights(const Observations& seen, const SurfaceState& state, const Gloss& gloss, int image,
                         Observations& matt) {
  const Lamp& lamp = state.lamps[static_cast<size_t>(image)];
  const auto pixels = static_cast<size_t>(seen.pixels);
  std::vector<float> share(pixels), radiance(pixels);
  std::vector<unsigned char> usable(pixels);
  for (int p = 0; p < seen.pixels; ++p)
    share[static_cast<size_t>(p)] = static_cast<float>(
        highlight_lobes(lamp, state.points.col(p), state.normals.col(p), state.scene).dot(gloss));
  for (int c = 0; c < 3; ++c) {
    const ChannelSamples samples = seen.channel(image, c);
    for (int p = 0; p < seen.pixels; ++p) {
      const auto k = static_cast<size_t>(p);
      usable[k] = samples.usable(p) ? 1 : 0;
      radiance[k] = samples[p] - share[k] * lamp.strength[c];
    }
    matt.set_channel(image, c, radiance.data(), usable.data());
  }
}

}  // namespace

void take_off_highlights(const Observations& seen, const SurfaceState& state, const Gloss& gloss,
                         Observations& matt) {
  cv::parallel_for_(cv::Range(0, seen.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) take_off_highlights(seen, state, gloss, i, matt);
  });
}

}  // namespace rakelight
