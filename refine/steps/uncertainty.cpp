// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/uncertainty.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

constexpr double kSensorReach =
    12;  // depth pixels over which the sensor's errors agree: wider than block matching's windows

/// Size of all errors of the images' model to those that differ between images, and of the normals' errors to the change
/// between neighbours. Fitted together on rendered scans of six objects, far and near lamps, with and without shadows,
/// highlights and noise, so that about two thirds of the errors lie inside one deviation.
constexpr float kSharedErrors = 8;
constexpr double kPixelRelief = 0.35;

constexpr int kWindow = 7;  // pixels; sixteen draws give 18 % of a deviation, neighbours together less

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
      : positions_(cell_positions(depth.grid, depth.prior.cells, scale)),
        size_((depth.grid.index.cols + scale - 1) / scale, (depth.grid.index.rows + scale - 1) / scale),
        miss_(depth.prior.cell_target - cell_means(depth.prior.cells, zeta)) {}

  Eigen::VectorXd change_of_target(Random& random) const {
    const cv::Mat1f field = smooth_field(size_, kSensorReach, random);
    Eigen::VectorXd change = miss_;
    for (Eigen::Index cell = 0; cell < change.size(); ++cell)
      change[cell] *= static_cast<double>(field(positions_[static_cast<size_t>(cell)]));
    return change;
  }

 private:
  std::vector<cv::Point> positions_;
  cv::Size size_;
  Eigen::VectorXd miss_;
};

std::vector<float> factors_of_images(int images, Random& random) {
  std::normal_distribution<float> gaussian(0, kSharedErrors);
  std::vector<float> factor(static_cast<size_t>(images));
  for (float& f : factor) f = gaussian(random);
  return factor;
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

/// What images and albedo add up to at one pixel.
struct PixelSums {
  Eigen::Vector3f q = Eigen::Vector3f::Zero();       ///< sum factor w rho l r, r = I - rho S
  Eigen::Matrix3f by_rho = Eigen::Matrix3f::Zero();  ///< column c: sum w l (r - rho S), the change by rho_c
  Eigen::Vector3f Sr = Eigen::Vector3f::Zero();      ///< sum factor w S r
  Eigen::Vector3f SS = Eigen::Vector3f::Zero();      ///< sum w S^2

  Eigen::Vector3f h() const { return q + by_rho * Sr.cwiseQuotient(SS.cwiseMax(1e-8f)); }
};

void add_image(const Observations& images, const SurfaceState& state, int i, int p, float factor,
               PixelSums& sums) {
  const auto at = static_cast<size_t>(i) * static_cast<size_t>(images.pixels) + static_cast<size_t>(p);
  const float w = state.weight[at];
  if (w == 0.0f) return;
  const Eigen::Vector3f n = state.normals.col(p), rho = state.albedo.col(p),
                        usable = images.usable_channels(i, p);
  const LocalLight light = light_at(state.lamps[static_cast<size_t>(i)], state.points.col(p), n, state.scene);
  const Eigen::Vector3f lit = light.l * n, S = usable.cwiseProduct(shading(light, n, state.attached_shadows));
  const Eigen::Vector3f r = usable.cwiseProduct(images.radiance_at(i, p)) - rho.cwiseProduct(S);
  sums.SS += w * S.cwiseAbs2();
  sums.Sr += factor * w * S.cwiseProduct(r);
  for (int c = 0; c < 3; ++c) {
    if (usable[c] == 0.0f || (state.attached_shadows && lit[c] <= 0.0f)) continue;
    const Eigen::Vector3f l = w * light.l.row(c).transpose();
    sums.by_rho.col(c) += (r[c] - rho[c] * S[c]) * l;
    sums.q += factor * rho[c] * r[c] * l;
  }
}

}  // namespace

Eigen::Matrix3Xf h_of_scaled_residuals(const Observations& images, const SurfaceState& state,
                                       const std::vector<float>& factor) {
  Eigen::Matrix3Xf h(3, images.pixels);
  for_each_block(images.pixels, [&](int begin, int end) {
    std::vector<PixelSums> sums(static_cast<size_t>(end - begin));
    for (int i = 0; i < images.images; ++i)
      for (int p = begin; p < end; ++p)
        add_image(images, state, i, p, factor[static_cast<size_t>(i)], sums[static_cast<size_t>(p - begin)]);
    for (int p = begin; p < end; ++p) h.col(p) = sums[static_cast<size_t>(p - begin)].h();
  });
  return h;
}

Uncertainty estimate_uncertainty(const DepthProblem& depth, int scale, const Observations& images,
                                 const SurfaceState& state, DepthSolver& solver, int draws) {
  if (draws == 0) return {};
  constexpr auto kGaussNewton = Linearization::gauss_newton;
  Random random(1);
  const SensorDraws sensor(depth, scale, state.zeta);
  const DepthSystem system = depth_system(depth, state.zeta, kGaussNewton);
  PhotometricTensors tensors = depth.tensors;
  DepthPrior prior = depth.prior;
  Eigen::VectorXd zeta_square = Eigen::VectorXd::Zero(depth.grid.size()), normal_square = zeta_square;
  Eigen::VectorXd change = zeta_square;
  if (!solver.solve(system, change)) return {};

  for (int k = 0; k < draws; ++k) {
    prior.cell_target = depth.prior.cell_target + sensor.change_of_target(random);
    const Eigen::Matrix3Xf h = h_of_scaled_residuals(images, state, factors_of_images(images.images, random));
    for (size_t p = 0; p < tensors.size(); ++p) {
      PhotometricTensor drawn = depth.tensors[p];
      drawn.h += h.col(static_cast<Eigen::Index>(p));
      tensors.set(p, drawn);
    }
    const DepthProblem drawn{depth.grid, depth.corners, tensors, depth.corner_weight, prior};
    const Eigen::VectorXd rhs = depth_system(drawn, state.zeta, kGaussNewton).rhs - system.rhs;
    if (!solver.solve_again(rhs, change)) return {};
    zeta_square += change.cwiseAbs2() / draws;
    const Eigen::Matrix3Xf moved = surface_normals(depth.grid, depth.corners, state.zeta + change);
    normal_square += (moved - state.normals).colwise().squaredNorm().transpose().cast<double>() / draws;
  }
  normal_square += kPixelRelief * kPixelRelief * change_between_neighbors(depth.grid, state.normals);
  return {(smoothed(depth.grid, zeta_square).array().sqrt() * state.zeta.array().exp()).matrix(),
          smoothed(depth.grid, normal_square).cwiseSqrt()};
}

}  // namespace rakelight
