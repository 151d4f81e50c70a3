// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/matt_images.h"

#include <opencv2/core/utility.hpp>

#include "refine/kernels/image_kernels.h"
#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {
namespace {

/// sum_j gloss_j |v| (n.h)^m_j at every pixel: what a lamp of strength 1 adds.
std::vector<float> highlight(const kernels::NearLight& light, const SurfaceState& state, const Gloss& gloss) {
  constexpr int kTile = kernels::kTilePixels;
  const auto pixels = static_cast<int>(state.zeta.size());
  std::vector<float> share(static_cast<size_t>(pixels));
  kernels::TileRow point[3] = {}, normal[3] = {}, broad, sharp;
  const kernels::PointRuns at{{point[0].at, point[1].at, point[2].at},
                              {normal[0].at, normal[1].at, normal[2].at}};
  float* lobes[] = {broad.at, sharp.at};
  for (int begin = 0; begin < pixels; begin += kTile) {
    const int count = std::min(kTile, pixels - begin);
    kernels::deinterleave3(state.points.col(begin).data(), count, point);
    kernels::deinterleave3(state.normals.col(begin).data(), count, normal);
    kernels::highlight_lobes(light, at, static_cast<int>(padded(static_cast<size_t>(count))), lobes);
    for (int k = 0; k < count; ++k)
      share[static_cast<size_t>(begin) + static_cast<size_t>(k)] =
          static_cast<float>(gloss[0]) * broad.at[k] + static_cast<float>(gloss[1]) * sharp.at[k];
  }
  return share;
}

void take_off_highlights(const Observations& seen, const SurfaceState& state, const Gloss& gloss, int image,
                         Observations& matt) {
  const Lamp& lamp = state.lamps[static_cast<size_t>(image)];
  if (!lamp.near) {
    for (int c = 0; c < 3; ++c) matt.copy_channel(seen, image, image, c);
    return;
  }
  const auto pixels = static_cast<size_t>(seen.pixels);
  const std::vector<float> share = highlight(near_light(lamp, state.scene), state, gloss);
  std::vector<float> radiance(pixels);
  std::vector<unsigned char> usable(pixels);
  for (int c = 0; c < 3; ++c) {
    const ChannelSamples samples = seen.channel(image, c);
    for (size_t k = 0; k < pixels; ++k) {
      usable[k] = samples.usable(static_cast<int>(k)) ? 1 : 0;
      radiance[k] = samples[static_cast<int>(k)] - share[k] * lamp.strength[c];
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
