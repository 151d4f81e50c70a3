// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo.h"

#include "refine/image_sums.h"

namespace rakelight {
namespace {

/// Columns [begin, end) of a 3 x pixels matrix; four at a time make whole vectors.
Eigen::Vector3d sum_of_columns(const Eigen::Matrix3Xf& albedo, int begin, int end) {
  using FourPixels = Eigen::Array<float, 3, 4>;
  FourPixels sums = FourPixels::Zero();
  int p = begin;
  for (; p + 4 <= end; p += 4) sums += FourPixels::Map(albedo.col(p).data());
  const Eigen::Vector3f rest = albedo.middleCols(p, end - p).rowwise().sum();
  return (sums.rowwise().sum().matrix() + rest).cast<double>();
}

}  // namespace

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
  const Eigen::Vector3d mean =
      sum_over_blocks(pixels, Eigen::Vector3d(0, 0, 0),
                      [&](int begin, int end) { return sum_of_columns(state.albedo, begin, end); }) /
      pixels;
  const Eigen::Vector3f scale = (mean.array() > 0).select(mean, 1.0).cast<float>();
  for_each_block(pixels, [&](int begin, int end) {
    state.albedo.middleCols(begin, end - begin).array().colwise() *= scale.array().inverse();
  });
  for (Lamp& lamp : state.lamps) {
    lamp.l = scale.asDiagonal() * lamp.l;
    for (size_t c = 0; c < 3; ++c) lamp.Q[c] *= scale[static_cast<Eigen::Index>(c)];
    lamp.phi = lamp.phi.cwiseProduct(scale);
    lamp.strength = lamp.strength.cwiseProduct(scale);
  }
}

}  // namespace rakelight
