// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo_smooth.h"

#include <algorithm>
#include <cmath>

#include "refine/solver/placement.h"
#include "refine/steps/albedo_palette.h"
#include "refine/steps/super_resolution.h"

namespace rakelight {
namespace {

constexpr float kDarkest =
    1e-3f;  // of the brightest value: below, a logarithm says more of noise than of paint
// Of the change since the last estimate, in the preconditioner's norm.
constexpr double kAlbedoTolerance = 1e-2;
constexpr float kDimShading = 0.1f;  // of the median shading: below, a pixel does not speak for the albedo

float brightest(const Observations& image) {
  float most = 1e-6f;
  for (int c = 0; c < 3; ++c)
    for (int p = 0; p < image.pixels; ++p) most = std::max(most, image.channel(0, c)[p]);
  return most;
}

Eigen::Matrix3Xd log_radiance(const Observations& image) {
  const float least = kDarkest * brightest(image);
  Eigen::Matrix3Xd logs(3, image.pixels);
  for (int c = 0; c < 3; ++c)
    for (int p = 0; p < image.pixels; ++p)
      logs(c, p) = std::log(static_cast<double>(std::max(least, image.channel(0, c)[p])));
  return logs;
}

Eigen::Matrix3Xf shading_of(const SurfaceState& state) {
  Eigen::Matrix3Xf S(3, state.normals.cols());
  for (Eigen::Index p = 0; p < S.cols(); ++p) {
    const Eigen::Vector3f n = state.normals.col(p);
    S.col(p) = shading(light_at(state.lamps.front(), state.points.col(p), n, state.scene), n,
                       state.attached_shadows);
  }
  return S;
}

float median_of(const Eigen::Matrix3Xf& values) {
  std::vector<float> sorted(values.data(), values.data() + values.size());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

}  // namespace

EdgeWeights color_edge_weights(const PixelGrid& grid, const Observations& image,
                               const AlbedoOptions& options) {
  const Eigen::Matrix3Xd logs = log_radiance(image);
  const double inverse = 1 / (2 * options.edge_sigma * options.edge_sigma);
  const auto weight = [&](int p, int q) {
    if (q < 0) return 0.0;
    return std::max(options.edge_floor, std::exp(-(logs.col(p) - logs.col(q)).squaredNorm() * inverse));
  };
  EdgeWeights edges;
  for (int p = 0; p < grid.size(); ++p) {
    edges.right.push_back(weight(p, grid.neighbor[kRight][static_cast<size_t>(p)]));
    edges.down.push_back(weight(p, grid.neighbor[kDown][static_cast<size_t>(p)]));
  }
  return edges;
}

AlbedoSmoother::AlbedoSmoother(const PixelGrid& grid, const Observations& image, const AlbedoOptions& options,
                               Solver solver)
    : grid_(grid),
      image_(image),
      options_(options),
      edges_(color_edge_weights(grid, image, options)),
      cells_(make_cells(grid, 1)),
      solver_(solver == Solver::exact ? make_cholesky_depth_solver(grid, cells_)
                                      : make_multigrid_depth_solver(grid, cells_, kAlbedoTolerance)),
      log_albedo_(Eigen::Matrix3Xd::Zero(3, grid.size())) {}

bool AlbedoSmoother::solve(const Eigen::VectorXd& weight, const Eigen::Matrix3Xd& weighted_target,
                           Eigen::Matrix3Xd& log_albedo) {
  const int count = grid_.size();
  const Placement placement(grid_);
  DepthSystem system(grid_);
  system.cell_weight = Eigen::VectorXd::Zero(count);
  Eigen::Matrix3Xd rest = weighted_target - log_albedo * weight.asDiagonal();
  placement.scatter(weight, 1, system.stencil.diagonal);
  const auto couple = [&](int p, int q, double v, float& entry) {
    if (q < 0) return;
    v *= options_.smoothness;
    system.stencil.diagonal[placement.place(p)] += static_cast<float>(v);
    system.stencil.diagonal[placement.place(q)] += static_cast<float>(v);
    entry = -static_cast<float>(v);
    const Eigen::Vector3d flow = v * (log_albedo.col(q) - log_albedo.col(p));
    rest.col(p) += flow;
    rest.col(q) -= flow;
  };
  for (int p = 0; p < count; ++p) {
    const auto i = static_cast<size_t>(p);
    const Eigen::Index place = placement.place(p);
    couple(p, grid_.neighbor[kRight][i], edges_.right[i], system.stencil.right[place]);
    couple(p, grid_.neighbor[kDown][i], edges_.down[i], system.stencil.down[place]);
  }
  placement.scatter(rest.row(0).transpose(), 1, system.rhs);
  for (int c = 0; c < 3; ++c) {
    Eigen::VectorXd correction;
    if (!(c == 0 ? solver_->solve(std::move(system), correction)
                 : solver_->solve_again(rest.row(c).transpose(), correction)))
      return false;
    log_albedo.row(c) += correction.transpose();
  }
  return log_albedo.allFinite();
}

bool AlbedoSmoother::estimate(const SurfaceState& state, Eigen::Matrix3Xf& albedo) {
  const Eigen::Matrix3Xf S = shading_of(state);
  const float dim = std::max(1e-6f, kDimShading * median_of(S));
  Eigen::Matrix3Xd target = log_radiance(image_);
  Eigen::VectorXd weight(grid_.size());
  for (int p = 0; p < grid_.size(); ++p) {
    constexpr double kUnknown =
        1e-2;  // keeps regions without any usable pixel determined, in single precision
    weight[p] = S.col(p).minCoeff() > dim && image_.usable_channels(0, p).minCoeff() > 0 ? 1.0 : kUnknown;
    target.col(p) -= S.col(p).cwiseMax(dim).array().log().matrix().cast<double>();
  }
  Eigen::Matrix3Xd& smooth = log_albedo_;
  if (!solve(weight, target * weight.asDiagonal(), smooth)) return false;
  if (options_.palette_bandwidth > 0 && options_.palette_weight > 0) {
    const PalettePull pull = palette_pull(smooth, options_.palette_bandwidth);
    const Eigen::VectorXd m = options_.palette_weight * pull.trust;
    if (!solve(weight + m, target * weight.asDiagonal() + pull.color * m.asDiagonal(), smooth)) return false;
  }
  albedo = smooth.array().exp().matrix().cast<float>();
  return true;
}

}  // namespace rakelight
