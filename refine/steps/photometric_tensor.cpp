// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/photometric_tensor.h"

#include <algorithm>

#include "refine/image_sums.h"
#include "refine/kernels/image_kernels.h"

namespace rakelight {
namespace {

constexpr size_t kPadding = 64;  // floats a vector kernel may read past the last pixel

void store(const kernels::TileTensors& tile, int begin, int count, PhotometricTensors& tensors) {
  using Part = PhotometricTensors::Part;
  const auto copy = [&](const kernels::TileRow& row, Part part) {
    std::copy_n(row.at, count, tensors.part(part) + begin);
  };
  copy(tile.xx, Part::xx);
  copy(tile.xy, Part::xy);
  copy(tile.xz, Part::xz);
  copy(tile.yy, Part::yy);
  copy(tile.yz, Part::yz);
  copy(tile.zz, Part::zz);
  copy(tile.hx, Part::hx);
  copy(tile.hy, Part::hy);
  copy(tile.hz, Part::hz);
  copy(tile.e0, Part::e0);
}

}  // namespace

PhotometricTensors::PhotometricTensors(size_t pixels)
    : pixels_(pixels), stride_(pixels / kPadding * kPadding + 2 * kPadding), parts_(kParts * stride_, 0.0f) {}

PhotometricTensor PhotometricTensors::operator[](size_t pixel) const {
  const auto at = [&](Part which) { return part(which)[pixel]; };
  PhotometricTensor tensor;
  tensor.G << at(xx), at(xy), at(xz), at(xy), at(yy), at(yz), at(xz), at(yz), at(zz);
  tensor.h << at(hx), at(hy), at(hz);
  tensor.e0 = at(e0);
  return tensor;
}

void PhotometricTensors::set(size_t pixel, const PhotometricTensor& tensor) {
  const Eigen::Matrix3f& G = tensor.G;
  const float numbers[kParts] = {G(0, 0), G(0, 1),     G(0, 2),     G(1, 1),     G(1, 2),
                                 G(2, 2), tensor.h[0], tensor.h[1], tensor.h[2], tensor.e0};
  for (size_t k = 0; k < kParts; ++k) parts_[k * stride_ + pixel] = numbers[k];
}

void reweigh_and_accumulate(const Observations& images, double scale, AlbedoRole role, SurfaceState& state,
                            PhotometricTensors& tensors) {
  const bool coupled = role == AlbedoRole::follows_normal;
  const auto pixels = static_cast<size_t>(images.pixels), count = state.lamps.size();
  state.weight.resize(count * pixels);
  const std::vector<kernels::TileLamp> lamps = tile_lamps(state);
  for_each_tile(images, state, [&](Tile& tile) {
    const auto weights_of = [&](size_t i) {
      return state.weight.data() + i * pixels + static_cast<size_t>(tile.begin());
    };
    std::vector<kernels::TileRow> last(tile.count() < kernels::kTilePixels ? count : 0);
    std::vector<float*> weights(count);
    for (size_t i = 0; i < count; ++i) weights[i] = last.empty() ? weights_of(i) : last[i].at;
    kernels::TileTensors sums{};
    kernels::AlbedoCoupling coupling{};
    kernels::reweigh_and_add_tensors(tile.surface(), tile.all(lamps), static_cast<float>(scale), {},
                                     weights.data(), sums, coupled ? &coupling : nullptr);
    if (coupled) kernels::eliminate_albedo(tile.surface(), coupling, sums);
    for (size_t i = 0; i < last.size(); ++i) std::copy_n(last[i].at, tile.count(), weights_of(i));
    store(sums, tile.begin(), tile.count(), tensors);
  });
}

PhotometricTensors accumulate_tensors(const Observations& images, const SurfaceState& state) {
  PhotometricTensors tensors(static_cast<size_t>(images.pixels));
  const ImageLamps lamps(images, state);
  for_each_tile(images, state, [&](Tile& tile) {
    ImageSums sums(lamps);
    for (const TileStretch& stretch : tile.stretches(lamps.lamps)) {
      sums.add_plain(tile, stretch);
      sums.find_tensors(tile, stretch, AlbedoRole::held);
    }
    store(sums.tensors(), tile.begin(), tile.count(), tensors);
  });
  return tensors;
}

void find_albedo_and_accumulate(const Observations& images, AlbedoRole role, SurfaceState& state,
                                PhotometricTensors& tensors) {
  const ImageLamps lamps(images, state);
  for_each_tile(images, state, [&](Tile& tile) {
    ImageSums sums(lamps);
    for (const TileStretch& stretch : tile.stretches(lamps.lamps)) {
      sums.add_plain(tile, stretch);
      sums.find_albedo(tile, stretch);
      sums.find_tensors(tile, stretch, role);
    }
    if (role == AlbedoRole::follows_normal) sums.eliminate_albedo(tile);
    tile.store_albedo(state.albedo);
    store(sums.tensors(), tile.begin(), tile.count(), tensors);
  });
}

}  // namespace rakelight
