// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/tiles.h"

#include <algorithm>
#include <limits>

#include "refine/kernels/image_kernels.h"

namespace rakelight {
namespace {

using kernels::kTilePixels;

/// Columns [begin, begin + count) of a 3 x pixels matrix as planar rows; the rest repeats the last column.
void copy_planar(const Eigen::Matrix3Xf& from, int begin, int count, kernels::TileRow (&rows)[3]) {
  kernels::deinterleave3(from.data() + 3 * static_cast<std::ptrdiff_t>(begin), count, rows);
  for (int c = 0; c < 3; ++c) std::fill(rows[c].at + count, rows[c].at + kTilePixels, rows[c].at[count - 1]);
}

}  // namespace

kernels::TileLamp tile_lamp(const Lamp& lamp, const SurfaceState& state) {
  kernels::TileLamp tile;
  tile.kind = lamp.near           ? kernels::LightKind::near
              : lamp.second_order ? kernels::LightKind::second_order
                                  : kernels::LightKind::far;
  tile.inverse_distance = lamp.inverse_distance;
  tile.lobe_exponent = state.scene.lobe_exponent;
  tile.least = state.attached_shadows ? 0.0f : -std::numeric_limits<float>::infinity();
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::Matrix3f& Q = lamp.Q[static_cast<size_t>(c)];
    const float packed[] = {Q(0, 0), Q(1, 1), Q(2, 2), Q(0, 1), Q(0, 2), Q(1, 2)};
    std::copy(std::begin(packed), std::end(packed), tile.Q[c]);
    for (Eigen::Index k = 0; k < 3; ++k) tile.l[c][k] = lamp.l(c, k);
    tile.phi[c] = lamp.phi[c];
    tile.direction[c] = lamp.direction[c];
    tile.strength[c] = lamp.strength[c];
  }
  return tile;
}

std::vector<kernels::TileLamp> tile_lamps(const SurfaceState& state) {
  std::vector<kernels::TileLamp> lamps;
  for (const Lamp& lamp : state.lamps) lamps.push_back(tile_lamp(lamp, state));
  return lamps;
}

Tile::Tile(const Observations& images, const SurfaceState& state)
    : images_(images),
      state_(state),
      any_near_(
          std::any_of(state.lamps.begin(), state.lamps.end(), [](const Lamp& lamp) { return lamp.near; })) {}

void Tile::move_to(int begin, int count) {
  begin_ = begin;
  count_ = count;
  copy_planar(state_.normals, begin, count, surface_.normal);
  copy_planar(state_.albedo, begin, count, surface_.albedo);
  if (!any_near_) return;
  copy_planar(state_.points, begin, count, surface_.offset);
  for (int k = 0; k < 3; ++k)
    for (float& value : surface_.offset[k].at) value -= state_.scene.center[k];
}

const kernels::TileImage& Tile::image(int i) {
  for (int c = 0; c < 3; ++c) {
    const ChannelSamples samples = images_.channel(i, c);
    image_.codes[c] = samples.codes() + begin_;
    image_.step[c] = samples.step();
    image_.least[c] = samples.least();
  }
  image_.weight = state_.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images_.pixels) +
                  static_cast<size_t>(begin_);
  if (count_ == kTilePixels) return image_;
  for (int c = 0; c < 3; ++c) {
    std::fill(std::copy_n(image_.codes[c], count_, codes_[c]), std::end(codes_[c]),
              kernels::TileImage::kUnusable);
    image_.codes[c] = codes_[c];
  }
  std::fill(std::copy_n(image_.weight, count_, weight_.at), std::end(weight_.at), 0.0f);
  image_.weight = weight_.at;
  return image_;
}

}  // namespace rakelight
