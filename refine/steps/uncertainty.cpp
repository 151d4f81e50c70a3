// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "refine/steps/albedo.h"

namespace rakelight {
namespace {

/// Depth errors of a real scan are broad waves: small errors of the lamp model add up over the object's width, which the
/// independent residuals of the formula do not know. Fitted on rendered scans of four objects, 70 to 390 depth pixels wide,
/// far and near lamps, so that about two thirds of the depth errors lie inside one deviation.
double broad_errors(const DepthCells& cells) {
  const double width = std::sqrt(static_cast<double>(cells.pixels_of.size()));
  return 0.11 * std::pow(width, 0.7);
}

/// For normals: errors that all images share (lamps, highlights wherever they fall) do not show in a jackknife,
/// and those of images without any flaw only in the formula.
constexpr double kSharedErrors = 5.5;
constexpr double kFormulaShare = 0.25;
constexpr int kGroups = 4;

constexpr int kDepthWindow = 7;    // 16 samples a pixel give 18 % of a deviation; 49 pixels together far less
constexpr int kNormalWindow = 21;  // four groups a pixel give 40 %

/// Mean over a window of the pixels inside the grid.
Eigen::VectorXd smoothed(const PixelGrid& grid, const Eigen::VectorXd& values, int window) {
  const cv::Size size(window, window);
  cv::Mat1f sum, count;
  cv::boxFilter(scatter(grid, values, 0.0f), sum, -1, size, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(scatter(grid, Eigen::VectorXd::Ones(values.size()), 0.0f), count, -1, size, {-1, -1}, false,
                cv::BORDER_CONSTANT);
  return gather(grid, sum).cwiseQuotient(gather(grid, count)).cwiseMax(0.0);
}

/// Squared spread of depth (log) and normals (radians) by the formula.
struct Spread {
  Eigen::VectorXd zeta, normal;
};

Spread sampled_spread(const DepthProblem& depth, const SurfaceState& state, DepthSolver& solver,
                      double residual_deviation, int samples) {
  const auto pixels = state.zeta.size();
  Spread spread{Eigen::VectorXd::Zero(pixels), Eigen::VectorXd::Zero(pixels)};
  Eigen::VectorXd white(pixels);
  std::mt19937_64 random(1);
  std::normal_distribution<double> gaussian;
  for (int k = 0; k < samples; ++k) {
    for (double& value : white) value = gaussian(random);
    const Eigen::VectorXd change = residual_deviation * solver.sample(white);
    spread.zeta += change.cwiseAbs2() / samples;
    const Eigen::Matrix3Xf moved = surface_normals(depth.grid, depth.corners, state.zeta + change);
    spread.normal += (moved - state.normals).colwise().squaredNorm().transpose().cast<double>() / samples;
  }
  return spread;
}

/// The normals after one more step without every kGroups-th image, the rest weighing as much as all.
Eigen::Matrix3Xf normals_without(int group, const DepthProblem& depth, const Observations& images,
                                 const SurfaceState& state, const DepthOptions& options, DepthSolver& solver) {
  SurfaceState part = state;
  int kept = 0;
  for (int i = 0; i < images.images; ++i) {
    if (i % kGroups != group) {
      ++kept;
      continue;
    }
    std::fill_n(part.weight.begin() + static_cast<std::ptrdiff_t>(i) * images.pixels, images.pixels, 0.0f);
  }
  part.albedo = estimate_albedo(images, part);
  auto tensors = accumulate_tensors(images, part);
  const float more = static_cast<float>(images.images) / static_cast<float>(kept);
  for (PhotometricTensor& tensor : tensors) {
    tensor.G *= more;
    tensor.h *= more;
    tensor.e0 *= more;
  }
  const DepthProblem without{depth.grid, depth.corners, tensors, depth.corner_weight, depth.prior};
  depth_step(without, options, solver, part.zeta);
  return surface_normals(depth.grid, depth.corners, part.zeta);
}

/// Squared deviation of the normals by the jackknife, radians^2.
Eigen::VectorXd jackknife(const DepthProblem& depth, const Observations& images, const SurfaceState& state,
                          const DepthOptions& options, DepthSolver& solver) {
  std::array<Eigen::Matrix3Xf, kGroups> normals;
  Eigen::Matrix3Xf mean = Eigen::Matrix3Xf::Zero(3, state.zeta.size());
  for (int k = 0; k < kGroups; ++k) {
    auto& n = normals[static_cast<size_t>(k)] = normals_without(k, depth, images, state, options, solver);
    mean += n / static_cast<float>(kGroups);
  }
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(state.zeta.size());
  for (const Eigen::Matrix3Xf& n : normals)
    variance += (n - mean).colwise().squaredNorm().transpose().cast<double>() * (kGroups - 1.0) / kGroups;
  return variance;
}

}  // namespace

Uncertainty estimate_uncertainty(const DepthProblem& depth, const Observations& images, const SurfaceState& state,
                                 const DepthOptions& options, DepthSolver& solver, double residual_deviation,
                                 int samples) {
  if (samples == 0) return {};
  const Spread formula = sampled_spread(depth, state, solver, residual_deviation, samples);
  const Eigen::VectorXd spread = jackknife(depth, images, state, options, solver);
  const Eigen::ArrayXd normal2 = std::pow(kSharedErrors, 2) * smoothed(depth.grid, spread, kNormalWindow).array() +
                                 std::pow(kFormulaShare, 2) * smoothed(depth.grid, formula.normal, kDepthWindow).array();
  return {broad_errors(depth.prior.cells) *
              (smoothed(depth.grid, formula.zeta, kDepthWindow).array().sqrt() * state.zeta.array().exp()),
          normal2.sqrt()};
}

}  // namespace rakelight
