// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_samples.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

constexpr double kLeastScale = 1e-3;  // radiance: rounding to 8 bits errs so much

std::vector<LampRegion> split_into_regions(std::vector<BroadPixel> pixels) {
  constexpr size_t kBands = 4, kColumns = kLampRegions / kBands;
  std::vector<LampRegion> regions;
  const auto cut = [](size_t count, size_t k, size_t parts) {
    return static_cast<std::ptrdiff_t>(count * k / parts);
  };
  for (size_t band = 0; band < kBands; ++band) {  // pixels come row by row
    const auto begin = pixels.begin() + cut(pixels.size(), band, kBands);
    const auto end = pixels.begin() + cut(pixels.size(), band + 1, kBands);
    std::sort(begin, end, [](const BroadPixel& a, const BroadPixel& b) { return a.point.x() < b.point.x(); });
    const auto count = static_cast<size_t>(end - begin);
    for (size_t k = 0; k < kColumns; ++k)
      regions.push_back({{begin + cut(count, k, kColumns), begin + cut(count, k + 1, kColumns)}, {}});
  }
  return regions;
}

/// Fills in images and highlights; the weights are the state's.
void look_at_images(const Observations& images, const SurfaceState& state, LampRegion& region) {
  const auto count = static_cast<Eigen::Index>(region.pixels.size());
  for (int i = 0; i < images.images; ++i) {
    const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
    const float* weight = state.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels);
    RegionImage image{Eigen::ArrayX3d(count, 3), Eigen::ArrayX3d(count, 3),
                      Eigen::Matrix<double, Eigen::Dynamic, kHighlightLobes>(count, kHighlightLobes)};
    for (Eigen::Index k = 0; k < count; ++k) {
      const BroadPixel& pixel = region.pixels[static_cast<size_t>(k)];
      image.I.row(k) = images.radiance_at(i, pixel.p).cast<double>().transpose();
      image.w.row(k) = (weight[pixel.p] * images.usable_channels(i, pixel.p)).cast<double>().transpose();
      image.lobes.row(k) = highlight_lobes(lamp, pixel.point, pixel.normal, state.scene).transpose();
    }
    region.images.push_back(std::move(image));
  }
}

/// What the state and its gloss leave of each image, a row a pixel, a column a channel.
std::vector<Eigen::ArrayX3d> residuals(const SurfaceState& state, const Gloss& gloss,
                                       const LampRegion& region) {
  std::vector<Eigen::ArrayX3d> result;
  Eigen::ArrayX3d SS = Eigen::ArrayX3d::Constant(static_cast<Eigen::Index>(region.pixels.size()), 3, 1e-12),
                  SI = 0 * SS;
  std::vector<Eigen::ArrayX3d> shadings;
  for (size_t i = 0; i < region.images.size(); ++i) {
    const RegionImage& image = region.images[i];
    const Lamp& lamp = state.lamps[i];
    Eigen::ArrayX3d S(image.I.rows(), 3);
    for (Eigen::Index k = 0; k < S.rows(); ++k) {
      const BroadPixel& pixel = region.pixels[static_cast<size_t>(k)];
      S.row(k) =
          shading(light_at(lamp, pixel.point, pixel.normal, state.scene), pixel.normal, true).cast<double>();
    }
    const Eigen::ArrayX3d I =
        image.I - (image.lobes * gloss * lamp.strength.cast<double>().transpose()).array();
    SS += image.w * S.square();
    SI += image.w * S * I;
    shadings.push_back(std::move(S));
    result.push_back(I);
  }
  for (size_t i = 0; i < result.size(); ++i) result[i] -= SI / SS * shadings[i];
  return result;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<LampRegion> sample_lamp_regions(const Observations& images, const BroadShape* shape,
                                            const SurfaceState& state, int pixels) {
  std::vector<BroadPixel> chosen;
  const int stride = std::max(1, images.pixels / pixels);
  for (int p = 0; p < images.pixels; p += stride) chosen.push_back(broad_pixel(shape, state, p));
  std::vector<LampRegion> regions = split_into_regions(std::move(chosen));
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k)
      look_at_images(images, state, regions[static_cast<size_t>(k)]);
  });
  return regions;
}

void forget_shadows(const SurfaceState& state, const Gloss& gloss, std::vector<LampRegion>& regions) {
  std::vector<std::vector<Eigen::ArrayX3d>> all(regions.size());
  cv::parallel_for_(cv::Range(0, static_cast<int>(regions.size())), [&](const cv::Range& range) {
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k)
      all[k] = residuals(state, gloss, regions[k]);
  });
  for (size_t i = 0; i < state.lamps.size(); ++i) {
    std::vector<double> sizes;
    for (size_t k = 0; k < regions.size(); ++k)
      for (Eigen::Index j = 0; j < all[k][i].size(); ++j)
        if (regions[k].images[i].w(j) > 0) sizes.push_back(std::abs(all[k][i](j)));
    if (sizes.empty()) continue;
    const double scale = std::max(kLeastScale, 1.4826 * median(std::move(sizes)));
    for (size_t k = 0; k < regions.size(); ++k) {
      Eigen::ArrayX3d& w = regions[k].images[i].w;
      w = (w > 0).select((1 + (all[k][i] / scale).square()).square().inverse(), 0.0);
    }
  }
}

}  // namespace rakelight
