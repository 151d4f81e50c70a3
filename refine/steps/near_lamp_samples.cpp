// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_samples.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

/// Pixels, which come row by row, in bands of rows, each cut into columns; by number in each region.
std::vector<std::vector<int>> split_into_regions(std::vector<int> pixels, const Eigen::Matrix3Xf& points) {
  constexpr size_t kBands = 4, kColumns = kLampRegions / kBands;
  const auto cut = [](size_t count, size_t k, size_t parts) {
    return static_cast<std::ptrdiff_t>(count * k / parts);
  };
  std::vector<std::vector<int>> regions;
  for (size_t band = 0; band < kBands; ++band) {
    const auto begin = pixels.begin() + cut(pixels.size(), band, kBands);
    const auto end = pixels.begin() + cut(pixels.size(), band + 1, kBands);
    std::sort(begin, end, [&](int a, int b) { return points(0, a) < points(0, b); });
    const auto count = static_cast<size_t>(end - begin);
    for (size_t k = 0; k < kColumns; ++k) {
      std::vector<int> region(begin + cut(count, k, kColumns), begin + cut(count, k + 1, kColumns));
      if (region.empty()) continue;
      std::sort(region.begin(), region.end());
      regions.push_back(std::move(region));
    }
  }
  return regions;
}

/// The pixel of a row.
int pixel_of(const std::vector<int>& pixels, Eigen::Index row) {
  return pixels[std::min(static_cast<size_t>(row), pixels.size() - 1)];
}

RegionSamples samples_at(const Observations& images, std::vector<int> pixels) {
  const auto count = static_cast<Eigen::Index>(pixels.size());
  const Eigen::Index rows = padded(pixels.size()),
                     columns = sample_column(static_cast<size_t>(images.images), 0);
  RegionSamples samples{std::move(pixels), Eigen::ArrayXXf(rows, columns),
                        Eigen::ArrayXXf::Zero(rows, columns)};
  for (int i = 0; i < images.images; ++i) {
    for (int c = 0; c < 3; ++c) {
      const ChannelSamples channel = images.channel(i, c);
      const Eigen::Index column = sample_column(static_cast<size_t>(i), c);
      for (Eigen::Index k = 0; k < rows; ++k) {
        const int p = pixel_of(samples.pixels, k);
        samples.I(k, column) = channel[p];
        if (k < count && channel.usable(p)) samples.usable(k, column) = 1;
      }
    }
  }
  return samples;
}

/// Fills in how the surface may change.
void look_at_shape(const BroadShape* shape, const SurfaceState& state, LampRegion& region) {
  const std::vector<int>& pixels = region.samples->pixels;
  const Eigen::Index rows = region.samples->rows();
  region.B = Eigen::ArrayXXf::Zero(rows, kBroadChanges);
  region.normal_by_c = Eigen::ArrayXXf::Zero(rows, Eigen::Index{3} * kBroadChanges);
  region.prior_weight = region.prior_miss = Eigen::ArrayXd::Zero(rows);
  if (!shape) return;
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(pixels.size()); ++k) {
    const BroadPixel pixel = broad_pixel(*shape, state, pixels[static_cast<size_t>(k)]);
    region.B.row(k) = pixel.B;
    for (int axis = 0; axis < 3; ++axis)
      region.normal_by_c.block<1, kBroadChanges>(k, Eigen::Index{kBroadChanges} * axis) =
          pixel.normal_by_c.row(axis);
    region.prior_weight[k] = pixel.prior_weight;
    region.prior_miss[k] = pixel.prior_miss;
  }
}

/// Fills in the state's weights and the highlights of its lamps.
void look_at_lamps(const SurfaceState& state, LampRegion& region) {
  const auto images = static_cast<Eigen::Index>(state.lamps.size());
  const std::vector<int>& pixels = region.samples->pixels;
  const auto surface_pixels = static_cast<size_t>(state.zeta.size());
  region.w = region.samples->usable;
  region.lobes = Eigen::ArrayXXf::Zero(region.samples->rows(), kHighlightLobes * images);
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    const float* weight = state.weight.data() + i * surface_pixels;
    const Eigen::Index first = sample_column(i, 0), lobe = kHighlightLobes * static_cast<Eigen::Index>(i);
    for (size_t k = 0; k < pixels.size(); ++k)
      region.w.block<1, 3>(static_cast<Eigen::Index>(k), first) *= weight[pixels[k]];
    if (!state.lamps[i].near) continue;
    float* lobes[] = {region.lobes.col(lobe).data(), region.lobes.col(lobe + 1).data()};
    kernels::highlight_lobes(near_light(state.lamps[i], state.scene), region.surface.runs(),
                             region.surface.rows(), lobes);
  }
}

}  // namespace

std::vector<RegionSamples> sample_lamp_regions(const Observations& images, const SurfaceState& state,
                                               int pixels) {
  std::vector<int> chosen;
  const int stride = std::max(1, images.pixels / pixels);
  for (int p = 0; p < images.pixels; p += stride) chosen.push_back(p);
  const std::vector<std::vector<int>> regions = split_into_regions(std::move(chosen), state.points);
  std::vector<RegionSamples> samples(regions.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k)
      samples[k] = samples_at(images, regions[k]);
  });
  return samples;
}

std::vector<LampRegion> lamp_regions(const std::vector<RegionSamples>& samples, const BroadShape* shape,
                                     const SurfaceState& state) {
  std::vector<LampRegion> regions;
  for (const RegionSamples& of_region : samples)
    regions.push_back({&of_region, SurfacePoints(of_region.rows()), {}, {}, {}, {}, {}, {}});
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k) {
      LampRegion& region = regions[k];
      region.surface = SurfacePoints(state.points, state.normals, region.samples->pixels);
      look_at_shape(shape, state, region);
      look_at_lamps(state, region);
    }
  });
  return regions;
}

}  // namespace rakelight
