// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/noise.h"

#include <algorithm>
#include <cmath>

#include "refine/lamp_shading.h"

namespace rakelight {
namespace {

constexpr int kNoiseBlock = 4;     // depth pixels
constexpr double kCoverage = 0.5;  // share of a block that must count

double deviation(std::vector<double>& sizes) {
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

struct WeightedSum {
  double value = 0, weight = 0;
};

/// Sizes of one image's weighted residual over blocks of `block` refined pixels.
std::vector<double> block_residuals(const PixelGrid& grid, const Observations& images,
                                    const SurfaceState& state, int image, int block) {
  const int columns = (grid.index.cols + block - 1) / block, rows = (grid.index.rows + block - 1) / block;
  std::vector<WeightedSum> sums(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  ShadingBlock model;
  for (int begin = 0; begin < images.pixels; begin += kPixelBlock) {
    const int end = std::min(images.pixels, begin + kPixelBlock);
    shade(state.lamps[static_cast<size_t>(image)], state, begin, end, model);
    for (int p = begin; p < end; ++p) {
      if (images.usable_channels(image, p).minCoeff() == 0.0f) continue;
      const auto k = static_cast<size_t>(p - begin);
      const float modelled =
          state.albedo.col(p).dot(Eigen::Vector3f(model.S[0][k], model.S[1][k], model.S[2][k]));
      const cv::Point at = grid.pixels[static_cast<size_t>(p)];
      WeightedSum& sum = sums[static_cast<size_t>((at.y / block) * columns + at.x / block)];
      const float weight = state.trust(image, p);
      sum.value += static_cast<double>(weight * (modelled - images.radiance_at(image, p).sum()));
      sum.weight += static_cast<double>(weight * weight);
    }
  }
  std::vector<double> sizes;
  for (const WeightedSum& sum : sums) {
    if (sum.weight > kCoverage * block * block)
      sizes.push_back(std::abs(sum.value) / std::sqrt(3 * sum.weight));
  }
  return sizes;
}

double image_noise(const PixelGrid& grid, const Observations& images, const SurfaceState& state, int block) {
  std::vector<std::vector<double>> parts(static_cast<size_t>(images.images));
  cv::parallel_for_(cv::Range(0, images.images), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      parts[static_cast<size_t>(i)] = block_residuals(grid, images, state, i, block);
  });
  std::vector<double> sizes;
  for (const auto& part : parts) sizes.insert(sizes.end(), part.begin(), part.end());
  return deviation(sizes);
}

}  // namespace

double measure_sensor_noise(const PixelGrid& grid, const SurfaceState& state, const DepthPrior& prior,
                            int scale) {
  const int size = scale * kNoiseBlock;
  const int columns = (grid.index.cols + size - 1) / size, rows = (grid.index.rows + size - 1) / size;
  std::vector<WeightedSum> sums(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  const Eigen::VectorXd miss = prior.cell_target - cell_means(prior.cells, state.zeta);
  for (Eigen::Index cell = 0; cell < miss.size(); ++cell) {
    if (prior.cell_weight[cell] == 0) continue;
    const int first = *prior.cells.of(static_cast<int>(cell)).begin();
    const cv::Point at = grid.pixels[static_cast<size_t>(first)];
    WeightedSum& sum = sums[static_cast<size_t>((at.y / size) * columns + at.x / size)];
    sum.value += miss[cell];
    sum.weight += 1;
  }
  std::vector<double> sizes;
  const auto counts = [](const WeightedSum& sum) {
    return sum.weight > kCoverage * kNoiseBlock * kNoiseBlock;
  };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const WeightedSum& a = sums[static_cast<size_t>(y * columns + x)];
      const WeightedSum& b = sums[static_cast<size_t>(y * columns + x + 1)];
      if (!counts(a) || !counts(b)) continue;
      sizes.push_back(std::abs(a.value / a.weight - b.value / b.weight) /
                      std::sqrt(1 / a.weight + 1 / b.weight));
    }
  }
  return deviation(sizes);
}

MeasuredNoise measure_noise(const PixelGrid& grid, const Observations& images, const SurfaceState& state,
                            const DepthPrior& prior, int scale) {
  return {image_noise(grid, images, state, kNoiseBlock * scale),
          measure_sensor_noise(grid, state, prior, scale)};
}

}  // namespace rakelight
