// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "refine/steps/residual_draws.h"

namespace rakelight {
namespace {

constexpr double kSensorReach =
    12;  // depth pixels over which the sensor's errors agree: wider than block matching's windows

/// Size of all errors of the images' model to those that differ between images, and of the normals' errors to the change
/// between neighbours. Fitted together on rendered scans of six objects, far and near lamps, with and without shadows,
/// highlights and noise, so that about two thirds of the errors lie inside one deviation.
constexpr float kSharedErrors = 6;
constexpr double kPixelRelief = 0.25;

constexpr int kWindow = 7;  // pixels; sixteen draws give 18 % of a deviation, neighbours together less

/// Of each draw's solution: far below what sixteen draws leave open.
constexpr double kTolerance = 1e-2;

using Random = std::mt19937_64;

/// Gaussian field of unit variance that is correlated over about `reach` pixels.
cv::Mat1f smooth_field(cv::Size size, double reach, Random& random) {
  std::normal_distribution<float> gaussian;
  const int margin = static_cast<int>(std::ceil(1.5 * reach));
  cv::Mat1f field(size.height + 2 * margin, size.width + 2 * margin);
  for (float& value : field) value = gaussian(random);
  const double sigma = reach / 2;
  cv::GaussianBlur(field, field, {}, sigma, sigma);
  field *= 2 * sigma * std::sqrt(CV_PI);  // the blur leaves a deviation of 1 / (2 sigma sqrt(pi))
  return field(cv::Rect({margin, margin}, size)).clone();
}

/// Readings with the sensor's residuals multiplied by a smooth field.
class SensorDraws {
 public:
  SensorDraws(const DepthProblem& depth, int scale, const Eigen::VectorXd& zeta)
      : cells_(depth.prior.cells),
        positions_(cell_positions(depth.grid, cells_, scale)),
        box_(cv::boundingRect(positions_)),
        pull_(depth.prior.cell_weight.cwiseProduct(depth.prior.cell_target - cell_means(cells_, zeta))) {
    for (Eigen::Index cell = 0; cell < pull_.size(); ++cell)
      pull_[cell] /= static_cast<double>(cells_.of(static_cast<int>(cell)).size());
  }

  Eigen::VectorXd change_of_right_hand_side(Random& random) const {
    const cv::Mat1f field = smooth_field(box_.size(), kSensorReach, random);
    Eigen::VectorXd change(static_cast<Eigen::Index>(cells_.cell_of.size()));
    for (Eigen::Index p = 0; p < change.size(); ++p) {
      const int cell = cells_.cell_of[static_cast<size_t>(p)];
      change[p] = pull_[cell] * static_cast<double>(field(positions_[static_cast<size_t>(cell)] - box_.tl()));
    }
    return change;
  }

 private:
  const DepthCells& cells_;
  std::vector<cv::Point> positions_;
  cv::Rect box_;          ///< of the positions
  Eigen::VectorXd pull_;  ///< [cell] weight * (reading - refined depth) / pixels of the cell
};

DrawFactors factors_of_images(int images, Random& random) {
  std::normal_distribution<float> gaussian(0, kSharedErrors);
  DrawFactors factors(images, kDrawsAtATime);
  for (int k = 0; k < kDrawsAtATime; ++k)
    for (int i = 0; i < images; ++i) factors(i, k) = gaussian(random);
  return factors;
}

/// Mean over a window of the pixels inside the grid.
Eigen::VectorXd smoothed(const PixelGrid& grid, const Eigen::VectorXd& values) {
  const cv::Size window(kWindow, kWindow);
  cv::Mat1f sum, count;
  cv::boxFilter(scatter(grid, values, 0.0f), sum, -1, window, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(scatter(grid, Eigen::VectorXd::Ones(values.size()), 0.0f), count, -1, window, {-1, -1}, false,
                cv::BORDER_CONSTANT);
  return gather(grid, sum).cwiseQuotient(gather(grid, count)).cwiseMax(0.0);
}

/// Mean square angle to the neighbours' normals, radians^2.
Eigen::VectorXd change_between_neighbors(const PixelGrid& grid, const Eigen::Matrix3Xf& normals) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(grid.size());
  for (int p = 0; p < grid.size(); ++p) {
    int count = 0;
    for (const auto& neighbor : grid.neighbor) {
      const int q = neighbor[static_cast<size_t>(p)];
      if (q < 0) continue;
      change[p] += static_cast<double>((normals.col(q) - normals.col(p)).squaredNorm());
      ++count;
    }
    if (count > 0) change[p] /= count;
  }
  return change;
}

}  // namespace

Uncertainty estimate_uncertainty(const DepthProblem& depth, int scale, const Observations& images,
                                 const SurfaceState& state, int draws) {
  if (draws == 0) return {};
  Random random(1);
  const SensorDraws sensor(depth, scale, state.zeta);
  const auto solver = make_multigrid_depth_solver(depth.grid, depth.prior.cells, kTolerance);
  Eigen::VectorXd zeta_square = Eigen::VectorXd::Zero(depth.grid.size()), normal_square = zeta_square;
  Eigen::VectorXd change = zeta_square;
  if (!solver->solve(depth_system(depth, state.zeta, Linearization::gauss_newton), change)) return {};

  for (int first = 0; first < draws; first += kDrawsAtATime) {
    const DrawFactors factors = factors_of_images(images.images, random);
    const DrawnSides rhs =
        right_hand_sides(depth, state.zeta, pulls_of_scaled_residuals(images, state, factors));
    for (int k = 0; k < std::min(kDrawsAtATime, draws - first); ++k) {
      if (!solver->solve_again(rhs.col(k) + sensor.change_of_right_hand_side(random), change)) return {};
      zeta_square += change.cwiseAbs2() / draws;
      const Eigen::Matrix3Xf moved = surface_normals(depth.grid, depth.corners, state.zeta + change);
      normal_square += (moved - state.normals).colwise().squaredNorm().transpose().cast<double>() / draws;
    }
  }
  normal_square += kPixelRelief * kPixelRelief * change_between_neighbors(depth.grid, state.normals);
  return {(smoothed(depth.grid, zeta_square).array().sqrt() * state.zeta.array().exp()).matrix(),
          smoothed(depth.grid, normal_square).cwiseSqrt()};
}

}  // namespace rakelight
