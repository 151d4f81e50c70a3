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
  const auto pixels = static_cast<int>(state.albedo.cols());
  const auto block_sum = [&](int begin, int end) -> Eigen::Vector3d {
    return state.albedo.middleCols(begin, end - begin).rowwise().sum().cast<double>();
  };
  const Eigen::Vector3d mean = sum_over_blocks(pixels, Eigen::Vector3d(0, 0, 0), block_sum) / pixels;
  const Eigen::Vector3f scale = (mean.array() > 0).select(mean, 1.0).cast<float>();
  const Eigen::Vector3f inverse = scale.cwiseInverse();
  for_each_block(pixels, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) state.albedo.col(p) = state.albedo.col(p).cwiseProduct(inverse);
  });
  for (Lamp& lamp : state.lamps) {
    lamp.l = scale.asDiagonal() * lamp.l;
    for (size_t c = 0; c < 3; ++c) lamp.Q[c] *= scale[static_cast<Eigen::Index>(c)];
    lamp.phi = lamp.phi.cwiseProduct(scale);
    lamp.strength = lamp.strength.cwiseProduct(scale);
  }
}

}  // namespace rakelight
