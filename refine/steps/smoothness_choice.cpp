// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/smoothness_choice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "refine/steps/image_agreement.h"

namespace rakelight {
namespace {

constexpr std::array kShares{1.0, 0.3, 0.1, 0.03};
constexpr int kPasses = 2;  // the second with edges where the first found them
constexpr int kLag = 6;     // depth pixels: neighbours would judge the finest detail alone
constexpr double kSlack =
    32;  // over the root of the pixels: share of the best's gain that chance accounts for
constexpr double kTelling = 0.01;  // gain below which shares are not told apart

/// The minimum of sum w (K zeta - target)^2 + smoothness |D2 zeta|^2. @return false when singular
bool smooth_sensor(const PixelGrid& grid, const DepthPrior& prior, const CurvaturePrior& curvature,
                   double smoothness, DepthSolver& solver, Eigen::VectorXd& zeta) {
  for (int pass = 0; pass < kPasses; ++pass) {
    DepthSystem system(grid);
    add_prior(grid, prior, zeta, system);
    add_curvature(grid, curvature.at(zeta, smoothness), zeta, system);
    Eigen::VectorXd step;
    if (!solver.solve(system, step)) return false;
    zeta += step;
  }
  return true;
}

/// The least smoothness whose gain is the best's but for chance: details that the image hardly misses are lost all the
/// same. Where the image hardly tells at all, the best.
SmoothnessChoice most_careful(const std::array<double, kShares.size()>& gains, int pixels) {
  const double best = *std::max_element(gains.begin(), gains.end());
  if (best <= 0) return {kShares.back(), gains.back()};  // the object's detail stands out from the noise
  const double enough = best > kTelling ? best * std::max(0.5, 1 - kSlack / std::sqrt(pixels)) : best;
  size_t k = gains.size() - 1;
  while (gains[k] < enough) --k;
  return {kShares[k], gains[k]};
}

}  // namespace

std::optional<SmoothnessChoice> choose_smoothness(const RefineProblem& problem, const DepthPrior& prior,
                                                  const CurvaturePrior& curvature, DepthSolver& solver,
                                                  const Eigen::Matrix3Xf& broad_normals, double balance) {
  const PixelGrid& grid = problem.grid;
  const CornerList corners = make_corners(grid, Stencil::forward, problem.cut_right, problem.cut_down);
  const ImageAgreement image(grid, problem.images, broad_normals, kLag * problem.scale);
  const double start = image.disagreement(surface_normals(grid, corners, prior.start));
  if (start <= 0) return SmoothnessChoice{1, 0};  // the image says nothing
  DepthPrior weighted = prior;
  weighted.cell_weight *= balance;
  weighted.floor *= balance;
  std::array<double, kShares.size()> gains{};
  for (size_t k = 0; k < kShares.size(); ++k) {
    Eigen::VectorXd zeta = prior.start;
    if (!smooth_sensor(grid, weighted, curvature, kShares[k], solver, zeta)) return std::nullopt;
    gains[k] = 1 - image.disagreement(surface_normals(grid, corners, zeta)) / start;
  }
  return most_careful(gains, grid.size());
}

}  // namespace rakelight
