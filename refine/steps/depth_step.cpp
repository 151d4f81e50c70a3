// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/depth_step.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

/// Calls body(k, corner) for the corners that pixel p has.
template <class Body>
void for_each_corner(const CornerList& corners, int p, const Body& body) {
  const auto& list = corners.corners[static_cast<size_t>(p)];
  for (size_t k = 0; k < list.size() && list[k].x_neighbor >= 0; ++k) body(k, list[k]);
}

float corner_energy(const DepthProblem& problem, int p, const Corner& corner, const Eigen::VectorXd& zeta) {
  const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
  const Eigen::Vector3f n = normal_frame(problem.grid, p).raw(g.x(), g.y()).normalized();
  return problem.tensors[static_cast<size_t>(p)].energy(n);
}

/// Half Hessian (2 x 2) and minus half gradient of e(n) by the gradient (zeta_x, zeta_y).
struct GradientEquations {
  Eigen::Matrix2f A;
  Eigen::Vector2f b;
};

GradientEquations gauss_newton(const PhotometricTensor& e, const NormalFrame& frame, const Eigen::Vector2f& g) {
  const Eigen::Vector3f raw = frame.raw(g.x(), g.y());
  const float d = raw.norm();
  const Eigen::Vector3f n = raw / d;
  const Eigen::Matrix<float, 3, 2> J = frame.jacobian() / d;
  const Eigen::Matrix<float, 3, 2> dn = J - n * (n.transpose() * J);
  return {dn.transpose() * e.G * dn, dn.transpose() * (e.h - e.G * n)};
}

GradientEquations fixed_point(const PhotometricTensor& e, const NormalFrame& frame, const Eigen::Vector2f& g) {
  const Eigen::Vector3f raw = frame.raw(g.x(), g.y());
  const float d = raw.norm();
  const Eigen::Matrix<float, 3, 2> J = frame.jacobian() / d;
  return {J.transpose() * e.G * J, J.transpose() * (e.h - e.G * (raw / d))};
}

/// Adds one corner's rows: zeta_x = sx (zeta_a - zeta_p), zeta_y = sy (zeta_b - zeta_p).
void scatter_corner(int p, const Corner& corner, const GradientEquations& equations,
                    DepthSystem& system) {
  const double sx = static_cast<double>(corner.x_sign), sy = static_cast<double>(corner.y_sign);
  const Eigen::Matrix2d A = equations.A.cast<double>();
  const double xx = A(0, 0), yy = A(1, 1), xy = A(0, 1) * sx * sy;
  const auto at = [](int q) { return static_cast<size_t>(q); };
  system.diagonal[at(p)] += xx + yy + 2 * xy;
  system.diagonal[at(corner.x_neighbor)] += xx;
  system.diagonal[at(corner.y_neighbor)] += yy;
  system.right[at(sx > 0 ? p : corner.x_neighbor)] -= xx + xy;
  system.down[at(sy > 0 ? p : corner.y_neighbor)] -= yy + xy;
  const int upper = sy > 0 ? corner.x_neighbor : corner.y_neighbor;  // the diagonal pair, stored at its upper pixel
  ((sx > 0) == (sy > 0) ? system.down_left : system.down_right)[at(upper)] += xy;
  const double bx = sx * static_cast<double>(equations.b.x()), by = sy * static_cast<double>(equations.b.y());
  system.rhs[corner.x_neighbor] += bx;
  system.rhs[corner.y_neighbor] += by;
  system.rhs[p] -= bx + by;
}

}  // namespace

std::vector<PhotometricTensor> accumulate_tensors(const Observations& images, const SurfaceState& state) {
  std::vector<PhotometricTensor> tensors(static_cast<size_t>(images.pixels));
  for_each_block(images.pixels, [&](int begin, int end) {
    for (int i = 0; i < images.images; ++i) {
      const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
      const float* weight = state.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels);
      for (int p = begin; p < end; ++p) {
        if (weight[p] == 0.0f) continue;
        const LocalLight light = light_at(lamp, state.points.col(p), state.scene);
        PhotometricTensor& sum = tensors[static_cast<size_t>(p)];
        for (int c = 0; c < 3; ++c) {
          if (!images.usable_in(i, c)[p]) continue;
          const float rho = state.albedo(c, p);
          const Eigen::Vector3f l = rho * light.l.row(c).transpose();
          const float rest = images.channel(i, c)[p] - rho * light.phi[c];
          sum.e0 += weight[p] * rest * rest;
          if (state.attached_shadows && l.dot(state.normals.col(p)) <= 0.0f) continue;
          sum.G += weight[p] * l * l.transpose();
          sum.h += weight[p] * rest * l;
        }
      }
    }
  });
  return tensors;
}

std::vector<std::array<float, 4>> corner_weights(const PixelGrid& grid, const CornerList& corners,
                                                 const std::vector<PhotometricTensor>& tensors,
                                                 const Eigen::VectorXd& zeta, double edge_weight) {
  std::vector<std::array<float, 4>> weights(static_cast<size_t>(grid.size()));
  std::vector<float> energies;
  for (int p = 0; p < grid.size(); ++p) {
    const size_t at = static_cast<size_t>(p);
    for_each_corner(corners, p, [&](size_t k, const Corner& corner) {
      const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
      weights[at][k] = std::max(0.0f, tensors[at].energy(normal_frame(grid, p).raw(g.x(), g.y()).normalized()));
      energies.push_back(weights[at][k]);
    });
  }
  float half = 0;
  if (edge_weight > 0 && !energies.empty()) {
    const auto middle = energies.begin() + static_cast<std::ptrdiff_t>(energies.size() / 2);
    std::nth_element(energies.begin(), middle, energies.end());
    half = static_cast<float>(edge_weight) * *middle;
  }
  for (int p = 0; p < grid.size(); ++p) {
    const size_t at = static_cast<size_t>(p);
    for (float& w : weights[at]) w = corners.weight[at] / (half > 0 ? 1.0f + w / half : 1.0f);
  }
  return weights;
}

double depth_energy(const DepthProblem& problem, const Eigen::VectorXd& zeta) {
  const double photometric = sum_over_blocks(problem.grid.size(), 0.0, [&](int begin, int end) {
    double sum = 0;
    for (int p = begin; p < end; ++p) {
      for_each_corner(problem.corners, p, [&](size_t k, const Corner& corner) {
        sum += static_cast<double>(problem.corner_weight[static_cast<size_t>(p)][k] *
                                   corner_energy(problem, p, corner, zeta));
      });
    }
    return sum;
  });
  return photometric + prior_energy(problem.prior, zeta);
}

DepthSystem depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta, Linearization linearization) {
  DepthSystem system(problem.grid.size());
  for (int p = 0; p < problem.grid.size(); ++p) {
    const NormalFrame frame = normal_frame(problem.grid, p);
    const PhotometricTensor& e = problem.tensors[static_cast<size_t>(p)];
    for_each_corner(problem.corners, p, [&](size_t k, const Corner& corner) {
      const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
      GradientEquations equations =
          linearization == Linearization::gauss_newton ? gauss_newton(e, frame, g) : fixed_point(e, frame, g);
      const float weight = problem.corner_weight[static_cast<size_t>(p)][k];
      equations.A *= weight;
      equations.b *= weight;
      scatter_corner(p, corner, equations, system);
    });
  }
  add_prior(problem.prior, zeta, system);
  return system;
}

DepthStepReport depth_step(const DepthProblem& problem, const DepthOptions& options, DepthSolver& solver,
                           Eigen::VectorXd& zeta) {
  DepthStepReport report;
  report.energy_before = report.energy_after = depth_energy(problem, zeta);
  Eigen::VectorXd step;
  report.solved = solver.solve(depth_system(problem, zeta, options.linearization), step);
  if (!report.solved) return report;
  for (double length = 1; report.backtracks <= options.max_backtracks; length /= 2, ++report.backtracks) {
    const Eigen::VectorXd candidate = zeta + length * step;
    report.energy_after = depth_energy(problem, candidate);
    if (report.energy_after <= report.energy_before || options.max_backtracks == 0) {
      zeta = candidate;
      return report;
    }
  }
  report.energy_after = report.energy_before;
  return report;
}

}  // namespace rakelight
