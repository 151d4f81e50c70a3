// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/robust_weights.h"

#include <algorithm>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

Eigen::Vector3f residual(const Observations& images, const SurfaceState& state, int i, int p) {
  const Eigen::Vector3f n = state.normals.col(p);
  const LocalLight light = light_at(state.lamps[static_cast<size_t>(i)], state.points.col(p), n, state.scene);
  const Eigen::Vector3f S = shading(light, n, state.attached_shadows);
  return state.albedo.col(p).cwiseProduct(S) - images.radiance_at(i, p);
}

/// Median of |value(image, pixel)| over usable samples and channels of images [first, last), from a fixed choice of pixels.
template <class Value>
double median_of_samples(const Observations& images, int first, int last, const Value& value) {
  constexpr int kSamples = 12000, kLeastAnImage = 750;  // pixels, three channels each: good to a percent
  const int an_image = std::max(kLeastAnImage, kSamples / std::max(1, last - first));
  const int step = std::max(1, images.pixels / an_image);
  std::vector<std::vector<float>> sizes(static_cast<size_t>(last - first));
  cv::parallel_for_(cv::Range(first, last), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      for (int p = i % step; p < images.pixels; p += step) {
        const Eigen::Vector3f v = value(i, p);
        for (int c = 0; c < 3; ++c)
          if (images.usable(i, c, p)) sizes[static_cast<size_t>(i - first)].push_back(std::abs(v[c]));
      }
    }
  });
  std::vector<float> all;
  for (const auto& of_image : sizes) all.insert(all.end(), of_image.begin(), of_image.end());
  if (all.empty()) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return static_cast<double>(*middle);
}

}  // namespace

double residual_scale(const Observations& images, const SurfaceState& state) {
  const auto value = [&](int i, int p) { return residual(images, state, i, p); };
  return 1.4826 * median_of_samples(images, 0, images.images, value);
}

double residual_scale_of_image(const Observations& images, const SurfaceState& state, int image) {
  const auto value = [&](int i, int p) { return residual(images, state, i, p); };
  return 1.4826 * median_of_samples(images, image, image + 1, value);
}

double median_radiance(const Observations& images) {
  return median_of_samples(images, 0, images.images, [&](int i, int p) { return images.radiance_at(i, p); });
}

std::vector<float> usable_weights(const Observations& images) {
  std::vector<float> weight(static_cast<size_t>(images.images) * static_cast<size_t>(images.pixels));
  for_each_block(images.pixels, [&](int begin, int end) {
    for (int i = 0; i < images.images; ++i) {
      float* of_image = weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels);
      for (int p = begin; p < end; ++p)
        of_image[p] =
            images.usable(i, 0, p) || images.usable(i, 1, p) || images.usable(i, 2, p) ? 1.0f : 0.0f;
    }
  });
  return weight;
}

}  // namespace rakelight
