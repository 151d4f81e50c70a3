// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "refine/kernels/image_kernels.h"
#include "refine/kernels/plain_kernels.h"

namespace rakelight {
namespace {

using kernels::kPiecePixels;
using kernels::kTilePixels;

/// Columns [begin, begin + count) of a 3 x pixels matrix as planar rows; the rest repeats the last column.
void copy_planar(const Eigen::Matrix3Xf& from, int begin, int count, kernels::TileRow (&rows)[3]) {
  kernels::deinterleave3(from.data() + 3 * static_cast<std::ptrdiff_t>(begin), count, rows);
  for (kernels::TileRow& row : rows) std::fill(row.at + count, row.at + kTilePixels, row.at[count - 1]);
}

/// Weights of samples without weights.
const kernels::TileRow kFullTrust = [] {
  kernels::TileRow row;
  std::fill(std::begin(row.at), std::end(row.at), 1.0f);
  return row;
}();

/// Whether no normal within the bounds can lie in the attached shadow of a far lamp of the first order, rounding included.
bool surely_lit(const kernels::TileLamp& lamp, const kernels::NormalBounds& normals) {
  constexpr float kRounding = 1e-6f;
  if (lamp.kind != kernels::LightKind::far) return false;
  for (const float(&l)[3] : lamp.l) {
    float lowest = 0, size = 0;
    for (int k = 0; k < 3; ++k) {
      lowest += std::min(l[k] * normals.least[k], l[k] * normals.most[k]);
      size += std::abs(l[k]);
    }
    if (!(lowest > lamp.least + kRounding * size)) return false;
  }
  return true;
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

Tile::Tile(const Observations& images, const SurfaceState& state, int step)
    : images_(images),
      state_(state),
      any_near_(
          std::any_of(state.lamps.begin(), state.lamps.end(), [](const Lamp& lamp) { return lamp.near; })),
      every_image_(static_cast<size_t>(images.images)),
      tile_images_(every_image_.size()) {
  std::iota(every_image_.begin(), every_image_.end(), 0);
  for (int i = 0; i < images_.images; ++i) {
    tile_images_[static_cast<size_t>(i)].next = step;
    for (int c = 0; c < 3; ++c) {
      const ChannelSamples samples = images_.channel(i, c);
      tile_images_[static_cast<size_t>(i)].step[c] = samples.step();
      tile_images_[static_cast<size_t>(i)].least[c] = samples.least();
    }
  }
}

void Tile::move_to(int begin, int count) {
  begin_ = begin;
  count_ = count;
  copy_planar(state_.normals, begin, count, surface_.normal);
  copy_planar(state_.albedo, begin, count, surface_.albedo);
  if (any_near_) {
    copy_planar(state_.points, begin, count, surface_.offset);
    for (int k = 0; k < 3; ++k)
      for (float& value : surface_.offset[k].at) value -= state_.scene.center[k];
  }
  for (int i = 0; i < images_.images; ++i) {
    kernels::TileImage& image = tile_images_[static_cast<size_t>(i)];
    for (int c = 0; c < 3; ++c) image.codes[c] = images_.channel(i, c).codes() + begin_;
    image.weight = state_.weight.empty()
                       ? kFullTrust.at
                       : state_.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images_.pixels) +
                             static_cast<size_t>(begin_);
  }
  if (count_ < kTilePixels && !state_.weight.empty()) fill_up();
}

/// The last tile has kTilePixels weights like the others.
void Tile::fill_up() {
  weights_.resize(tile_images_.size());
  for (size_t i = 0; i < tile_images_.size(); ++i) {
    std::fill(std::copy_n(tile_images_[i].weight, count_, weights_[i].at), std::end(weights_[i].at), 0.0f);
    tile_images_[i].weight = weights_[i].at;
  }
}

void Tile::store_albedo(Eigen::Matrix3Xf& albedo) const {
  kernels::interleave3(surface_.albedo, count_, albedo.data() + 3 * static_cast<std::ptrdiff_t>(begin_));
}

kernels::ImageChoice Tile::all(const std::vector<kernels::TileLamp>& lamps) const {
  return chosen(lamps, *this, every_image_);
}

/// Which images are plain, piece by piece.
class Tile::PlainSearch {
 public:
  PlainSearch(const Tile& tile, const std::vector<kernels::TileLamp>& lamps)
      : tile_(tile), lamps_(lamps), lit_(lamps.size()) {
    kernels::normal_bounds(tile.surface_, bounds_);
    kernels::NormalBounds whole = bounds_[0];
    for (const kernels::NormalBounds& bounds : bounds_) {
      for (int k = 0; k < 3; ++k) {
        whole.least[k] = std::min(whole.least[k], bounds.least[k]);
        whole.most[k] = std::max(whole.most[k], bounds.most[k]);
      }
    }
    for (size_t i = 0; i < lamps.size(); ++i) lit_[i] = surely_lit(lamps[i], whole);
  }

  /// @param plain [image]
  void in_piece(int piece, std::vector<char>& plain) const {
    const int of_all = tile_.begin_ / kPiecePixels + piece;
    for (size_t i = 0; i < lamps_.size(); ++i)
      plain[i] = tile_.images_.whole(static_cast<int>(i), of_all) &&
                 (lit_[i] || surely_lit(lamps_[i], bounds_[piece]));
  }

 private:
  const Tile& tile_;
  const std::vector<kernels::TileLamp>& lamps_;
  kernels::NormalBounds bounds_[kTilePixels / kPiecePixels];
  std::vector<char> lit_;  ///< [image] in the whole tile
};

const std::vector<TileStretch>& Tile::stretches(const std::vector<kernels::TileLamp>& lamps) {
  stretches_.clear();
  const int pieces = (count_ + kPiecePixels - 1) / kPiecePixels;
  std::optional<PlainSearch> search;
  if (state_.weight.empty()) search.emplace(*this, lamps);
  std::vector<char> plain(lamps.size(), 0), before;
  for (int piece = 0; piece < pieces; ++piece) {
    if (search) search->in_piece(piece, plain);
    if (piece == 0 || plain != before) {
      TileStretch next;
      next.pixels.begin = piece * kPiecePixels;
      for (size_t i = 0; i < plain.size(); ++i)
        (plain[i] ? next.plain : next.others).push_back(static_cast<int>(i));
      stretches_.push_back(std::move(next));
      before = plain;
    }
    stretches_.back().pixels.end = (piece + 1) * kPiecePixels;
  }
  return stretches_;
}

}  // namespace rakelight
