// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/curvature_prior.h"

#include <algorithm>
#include <cmath>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

constexpr double kEdge = 2;  // robust deviations of second differences at which one counts half

Eigen::VectorXd reachable(const PixelGrid& grid, Neighbor before, Neighbor after,
                          const std::vector<unsigned char>& cuts) {
  const auto is_cut = [&](int p) { return !cuts.empty() && cuts[static_cast<size_t>(p)] != 0; };
  Eigen::VectorXd reach(grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    const int a = grid.neighbor[before][static_cast<size_t>(p)],
              b = grid.neighbor[after][static_cast<size_t>(p)];
    reach[p] = a < 0 || b < 0 || is_cut(a) || is_cut(p) ? 0 : 1;
  }
  return reach;
}

/// Second differences where they can be reached, else 0.
Eigen::VectorXd differences(const PixelGrid& grid, Neighbor before, Neighbor after,
                            const Eigen::VectorXd& reach, const Eigen::VectorXd& zeta) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(zeta.size());
  for_each_block(grid.size(), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const auto i = static_cast<size_t>(p);
      if (reach[p] != 0)
        result[p] = zeta[grid.neighbor[before][i]] - 2 * zeta[p] + zeta[grid.neighbor[after][i]];
    }
  });
  return result;
}

/// Robust deviation of the values that are not exactly zero: those out of reach do not count.
double deviation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  std::vector<double> sizes;
  for (const Eigen::VectorXd* values : {&a, &b})
    for (const double value : *values)
      if (value != 0) sizes.push_back(std::abs(value));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return 1.4826 * *middle;
}

/// weight / (1 + (difference / half)^2) within reach.
Eigen::VectorXd sparing_edges(const Eigen::VectorXd& reach, const Eigen::VectorXd& difference, double half,
                              double weight) {
  if (half <= 0) return weight * reach;
  return weight * reach.array() / (1 + (difference / half).array().square());
}

}  // namespace

CurvatureWeights reachable_differences(const PixelGrid& grid, const std::vector<unsigned char>& cut_right,
                                       const std::vector<unsigned char>& cut_down) {
  return {reachable(grid, kLeft, kRight, cut_right), reachable(grid, kUp, kDown, cut_down)};
}

CurvaturePrior::CurvaturePrior(const PixelGrid& grid, const std::vector<unsigned char>& cut_right,
                               const std::vector<unsigned char>& cut_down)
    : grid_(grid), reach_(reachable_differences(grid, cut_right, cut_down)) {}

CurvatureWeights CurvaturePrior::at(const Eigen::VectorXd& zeta, double weight) const {
  const Eigen::VectorXd across = differences(grid_, kLeft, kRight, reach_.across, zeta);
  const Eigen::VectorXd down = differences(grid_, kUp, kDown, reach_.down, zeta);
  const double half = kEdge * deviation(across, down);
  return {sparing_edges(reach_.across, across, half, weight), sparing_edges(reach_.down, down, half, weight)};
}

}  // namespace rakelight
