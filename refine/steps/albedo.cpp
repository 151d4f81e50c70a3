// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo.h"

#include "refine/image_sums.h"

namespace rakelight {

Eigen::Matrix3Xf estimate_albedo(const Observations& images, const SurfaceState& state) {
  Eigen::Matrix3Xf albedo(3, state.albedo.cols());
  const ImageLamps lamps(images, state);
  for_each_tile(images, state, [&](Tile& tile) {
    ImageSums sums(lamps);
    for (const TileStretch& stretch : tile.stretches(lamps.lamps)) {
      sums.add_plain(tile, stretch);
      sums.find_albedo(tile, stretch);
    }
    tile.store_albedo(albedo);
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
