// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/curvature.h"

#include <algorithm>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

/// One axis: its weights and the neighbours its differences reach.
struct Axis {
  const Eigen::VectorXd& weight;
  const std::vector<int>&before, &after;
};

Axis across(const PixelGrid& grid, const CurvatureWeights& weights) {
  return {weights.across, grid.neighbor[kLeft], grid.neighbor[kRight]};
}

Axis down(const PixelGrid& grid, const CurvatureWeights& weights) {
  return {weights.down, grid.neighbor[kUp], grid.neighbor[kDown]};
}

double difference(const Axis& axis, const Eigen::VectorXd& x, int p) {
  const auto i = static_cast<size_t>(p);
  return axis.weight[p] == 0 ? 0 : x[axis.before[i]] - 2 * x[p] + x[axis.after[i]];
}

void add_product(const Axis& axis, const Eigen::VectorXd& x, Eigen::VectorXd& product) {
  const auto pixels = static_cast<int>(x.size());
  Eigen::VectorXd weighted(pixels);
  for_each_block(pixels, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) weighted[p] = axis.weight[p] * difference(axis, x, p);
  });
  const auto at = [&](int q) { return q < 0 ? 0.0 : weighted[q]; };
  for_each_block(pixels, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const auto i = static_cast<size_t>(p);
      product[p] += at(axis.before[i]) - 2 * weighted[p] + at(axis.after[i]);
    }
  });
}

void add_entries(const Axis& axis, std::vector<Eigen::Triplet<double>>& entries) {
  const auto add = [&](int a, int b, double value) {
    entries.emplace_back(std::max(a, b), std::min(a, b), value);
  };
  for (int p = 0; p < static_cast<int>(axis.weight.size()); ++p) {
    const double w = axis.weight[p];
    if (w == 0) continue;
    const int a = axis.before[static_cast<size_t>(p)], b = axis.after[static_cast<size_t>(p)];
    add(a, a, w);
    add(b, b, w);
    add(p, p, 4 * w);
    add(a, p, -2 * w);
    add(b, p, -2 * w);
    add(a, b, w);
  }
}

}  // namespace

double curvature_energy(const PixelGrid& grid, const CurvatureWeights& weights, const Eigen::VectorXd& x) {
  return sum_over_blocks(static_cast<int>(x.size()), 0.0, [&](int begin, int end) {
    double sum = 0;
    for (const Axis& axis : {across(grid, weights), down(grid, weights)}) {
      for (int p = begin; p < end; ++p) {
        const double d = difference(axis, x, p);
        sum += axis.weight[p] * d * d;
      }
    }
    return sum;
  });
}

Eigen::VectorXd curvature_product(const PixelGrid& grid, const CurvatureWeights& weights,
                                  const Eigen::VectorXd& x) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  add_product(across(grid, weights), x, product);
  add_product(down(grid, weights), x, product);
  return product;
}

Eigen::SparseMatrix<double> curvature_lower_triangle(const PixelGrid& grid, const CurvatureWeights& weights) {
  std::vector<Eigen::Triplet<double>> entries;
  add_entries(across(grid, weights), entries);
  add_entries(down(grid, weights), entries);
  Eigen::SparseMatrix<double> lower(grid.size(), grid.size());
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace rakelight
