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

GradientEquations gauss_newton(const PhotometricTensor& e, const NormalFrame& frame,
                               const Eigen::Vector2f& g) {
  const Eigen::Vector3f raw = frame.raw(g.x(), g.y());
  const float d = raw.norm();
  const Eigen::Vector3f n = raw / d;
  const Eigen::Matrix<float, 3, 2> J = frame.jacobian() / d;
  const Eigen::Matrix<float, 3, 2> dn = J - n * (n.transpose() * J);
  return {dn.transpose() * e.G * dn, dn.transpose() * (e.h - e.G * n)};
}

GradientEquations fixed_point(const PhotometricTensor& e, const NormalFrame& frame,
                              const Eigen::Vector2f& g) {
  const Eigen::Vector3f raw = frame.raw(g.x(), g.y());
  const float d = raw.norm();
  const Eigen::Matrix<float, 3, 2> J = frame.jacobian() / d;
  return {J.transpose() * e.G * J, J.transpose() * (e.h - e.G * (raw / d))};
}

/// One pixel's rows summed over its corners, zeta_x = sx (zeta_a - zeta_p), zeta_y = sy (zeta_b - zeta_p); the index of
/// a pair is the corner's, 2 (sy < 0) + (sx < 0).
struct PixelRows {
  std::array<double, 2> xx{}, yy{}, bx{}, by{};  ///< towards right and left, down and up
  std::array<double, 4> xy{};                    ///< signed: the entry of the pair (a, b)
};

/// Median over the corners there are.
float median_energy(const CornerList& corners, const std::vector<std::array<float, 4>>& energy) {
  std::vector<float> sorted;
  sorted.reserve(4 * energy.size());
  for (size_t p = 0; p < energy.size(); ++p)
    for_each_corner(corners, static_cast<int>(p),
                    [&](size_t k, const Corner&) { sorted.push_back(energy[p][k]); });
  if (sorted.empty()) return 0;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

constexpr size_t kRightDown = 0, kLeftDown = 1, kRightUp = 2, kLeftUp = 3;

void add_corner(const Corner& corner, const GradientEquations& equations, PixelRows& rows) {
  const auto sx = static_cast<double>(corner.x_sign), sy = static_cast<double>(corner.y_sign);
  const size_t x = sx > 0 ? 0 : 1, y = sy > 0 ? 0 : 1;
  rows.xx[x] += static_cast<double>(equations.A(0, 0));
  rows.yy[y] += static_cast<double>(equations.A(1, 1));
  rows.xy[2 * y + x] += static_cast<double>(equations.A(0, 1)) * sx * sy;
  rows.bx[x] += static_cast<double>(equations.b.x()) * sx;
  rows.by[y] += static_cast<double>(equations.b.y()) * sy;
}

/// Entry (i, i) and right-hand side of each pixel's row, and its entries to the pixels on the right and below: what
/// the pixel's own rows and those of its neighbours add up to.
void gather_rows(const PixelGrid& grid, const std::vector<PixelRows>& all, int p, DepthSystem& system) {
  const auto i = static_cast<size_t>(p);
  const PixelRows& own = all[i];
  static const PixelRows kNone;
  const auto of = [&](Neighbor direction) -> const PixelRows& {
    const int q = grid.neighbor[direction][i];
    return q < 0 ? kNone : all[static_cast<size_t>(q)];
  };
  const PixelRows &right = of(kRight), &left = of(kLeft), &down = of(kDown), &up = of(kUp);
  system.diagonal[i] = own.xx[0] + own.xx[1] + own.yy[0] + own.yy[1] +
                       2 * (own.xy[kRightDown] + own.xy[kLeftDown] + own.xy[kRightUp] + own.xy[kLeftUp]) +
                       left.xx[0] + right.xx[1] + up.yy[0] + down.yy[1];
  system.right[i] = -(own.xx[0] + own.xy[kRightDown] + own.xy[kRightUp]) -
                    (right.xx[1] + right.xy[kLeftDown] + right.xy[kLeftUp]);
  system.down[i] = -(own.yy[0] + own.xy[kRightDown] + own.xy[kLeftDown]) -
                   (down.yy[1] + down.xy[kRightUp] + down.xy[kLeftUp]);
  system.down_right[i] = right.xy[kLeftDown] + down.xy[kRightUp];
  system.down_left[i] = left.xy[kRightDown] + down.xy[kLeftUp];
  system.rhs[p] =
      left.bx[0] + right.bx[1] + up.by[0] + down.by[1] - (own.bx[0] + own.bx[1] + own.by[0] + own.by[1]);
}

}  // namespace

std::vector<std::array<float, 4>> corner_weights(const PixelGrid& grid, const CornerList& corners,
                                                 const PhotometricTensors& tensors,
                                                 const Eigen::VectorXd& zeta, double edge_weight) {
  std::vector<std::array<float, 4>> weights(static_cast<size_t>(grid.size()));
  for_each_block(grid.size(), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const size_t at = static_cast<size_t>(p);
      for_each_corner(corners, p, [&](size_t k, const Corner& corner) {
        const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
        weights[at][k] =
            std::max(0.0f, tensors[at].energy(normal_frame(grid, p).raw(g.x(), g.y()).normalized()));
      });
    }
  });
  const float half = edge_weight > 0 ? static_cast<float>(edge_weight) * median_energy(corners, weights) : 0;
  for (int p = 0; p < grid.size(); ++p) {
    const size_t at = static_cast<size_t>(p);
    for (float& w : weights[at]) w = corners.weight[at] / (half > 0 ? std::sqrt(1.0f + w / half) : 1.0f);
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
  const double smoothness =
      problem.curvature.empty() ? 0 : curvature_energy(problem.grid, problem.curvature, zeta);
  return photometric + prior_energy(problem.prior, zeta) + smoothness;
}

DepthSystem depth_system(const DepthProblem& problem, const Eigen::VectorXd& zeta,
                         Linearization linearization) {
  const int pixels = problem.grid.size();
  std::vector<PixelRows> rows(static_cast<size_t>(pixels));
  for_each_block(pixels, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      const NormalFrame frame = normal_frame(problem.grid, p);
      const PhotometricTensor e = problem.tensors[static_cast<size_t>(p)];
      for_each_corner(problem.corners, p, [&](size_t k, const Corner& corner) {
        const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
        GradientEquations equations = linearization == Linearization::gauss_newton ? gauss_newton(e, frame, g)
                                                                                   : fixed_point(e, frame, g);
        const float weight = problem.corner_weight[static_cast<size_t>(p)][k];
        equations.A *= weight;
        equations.b *= weight;
        add_corner(corner, equations, rows[static_cast<size_t>(p)]);
      });
    }
  });
  DepthSystem system(pixels);
  for_each_block(pixels, [&](int begin, int end) {
    for (int p = begin; p < end; ++p) gather_rows(problem.grid, rows, p, system);
  });
  add_prior(problem.prior, zeta, system);
  if (!problem.curvature.empty()) {
    system.curvature = problem.curvature;
    system.rhs -= curvature_product(problem.grid, problem.curvature, zeta);
  }
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
