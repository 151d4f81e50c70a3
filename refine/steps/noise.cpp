// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/noise.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr int kNoiseBlock = 4;       // depth pixels
constexpr double kCoverage = 0.5;    // share of a block that must count

double deviation(std::vector<double>& sizes) {
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

struct WeightedSum {
  double value = 0, weight = 0;
};

double image_noise(const PixelGrid& grid, const Observations& images, const SurfaceState& state, int block) {
  const int columns = (grid.index.cols + block - 1) / block, rows = (grid.index.rows + block - 1) / block;
  std::vector<double> sizes;
  for (int i = 0; i < images.images; ++i) {
    std::vector<WeightedSum> sums(static_cast<size_t>(columns) * static_cast<size_t>(rows));
    const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
    const float* weight = state.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels);
    for (int p = 0; p < images.pixels; ++p) {
      if (images.usable_channels(i, p).minCoeff() == 0.0f) continue;
      const Eigen::Vector3f S =
          shading(light_at(lamp, state.points.col(p), state.scene), state.normals.col(p), state.attached_shadows);
      const float modelled = state.albedo.col(p).dot(S);
      const float seen = images.channel(i, 0)[p] + images.channel(i, 1)[p] + images.channel(i, 2)[p];
      const cv::Point at = grid.pixels[static_cast<size_t>(p)];
      WeightedSum& sum = sums[static_cast<size_t>((at.y / block) * columns + at.x / block)];
      sum.value += static_cast<double>(weight[p] * (modelled - seen));
      sum.weight += static_cast<double>(weight[p] * weight[p]);
    }
    for (const WeightedSum& sum : sums) {
      if (sum.weight > kCoverage * block * block) sizes.push_back(std::abs(sum.value) / std::sqrt(3 * sum.weight));
    }
  }
  return deviation(sizes);
}

double depth_noise(const PixelGrid& grid, const SurfaceState& state, const DepthPrior& prior, int scale) {
  const int size = scale * kNoiseBlock;
  const int columns = (grid.index.cols + size - 1) / size, rows = (grid.index.rows + size - 1) / size;
  std::vector<WeightedSum> sums(static_cast<size_t>(columns) * static_cast<size_t>(rows));
  const Eigen::VectorXd miss = prior.cell_target - cell_means(prior.cells, state.zeta);
  for (Eigen::Index cell = 0; cell < miss.size(); ++cell) {
    if (prior.cell_weight[cell] == 0) continue;
    const int first = prior.cells.pixels_of[static_cast<size_t>(cell)].front();
    const cv::Point at = grid.pixels[static_cast<size_t>(first)];
    WeightedSum& sum = sums[static_cast<size_t>((at.y / size) * columns + at.x / size)];
    sum.value += miss[cell];
    sum.weight += 1;
  }
  std::vector<double> sizes;
  const auto counts = [](const WeightedSum& sum) { return sum.weight > kCoverage * kNoiseBlock * kNoiseBlock; };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x + 1 < columns; ++x) {
      const WeightedSum& a = sums[static_cast<size_t>(y * columns + x)];
      const WeightedSum& b = sums[static_cast<size_t>(y * columns + x + 1)];
      if (!counts(a) || !counts(b)) continue;
      sizes.push_back(std::abs(a.value / a.weight - b.value / b.weight) / std::sqrt(1 / a.weight + 1 / b.weight));
    }
  }
  return deviation(sizes);
}

}  // namespace

MeasuredNoise measure_noise(const PixelGrid& grid, const Observations& images, const SurfaceState& state,
                            const DepthPrior& prior, int scale) {
  return {image_noise(grid, images, state, kNoiseBlock * scale), depth_noise(grid, state, prior, scale)};
}

}  // namespace rakelight
