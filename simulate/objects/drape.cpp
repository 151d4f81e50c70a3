// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "simulate/objects/cloth.h"
#include "simulate/objects/objects.h"
#include "simulate/objects/parametric_grid.h"

namespace rakelight {
namespace {

/// Weights of the uniform cubic B-spline at u in [0, 1): twice differentiable, so folds shade without seams.
std::array<double, 4> spline_weights(double u) {
  const double v = 1 - u;
  return {v * v * v / 6, (3 * u * u * u - 6 * u * u + 4) / 6, (3 * v * v * v - 6 * v * v + 4) / 6,
          u * u * u / 6};
}

/// The cloth as a smooth surface over its nodes, (s, t) in [0, 1].
Eigen::Vector3d spline_point(const std::vector<Eigen::Vector3f>& nodes, int side, double s, double t) {
  const double x = s * (side - 1), y = t * (side - 1);
  const int column = std::min(static_cast<int>(x), side - 2), row = std::min(static_cast<int>(y), side - 2);
  const auto wx = spline_weights(x - column), wy = spline_weights(y - row);
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int c = std::clamp(column + i - 1, 0, side - 1), r = std::clamp(row + j - 1, 0, side - 1);
      point += wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] *
               nodes[static_cast<std::size_t>(r * side + c)].cast<double>();
    }
  }
  return point;
}

/// Creases: rounded ridges with wandering phase, finer than the cloth's nodes can carry. Height in object units.
double crease(double s, double t) {
  const auto ridge = [](double phase) { return std::exp(-std::pow(std::sin(phase) / 0.3, 2)); };
  const double wander =
      std::sin(9 * s + 4 * t) + 0.7 * std::sin(17 * t - 6 * s + 1.3) + 0.5 * std::sin(23 * s + 19 * t);
  const double strength = 0.5 + 0.5 * std::sin(7 * s + 5 * t + wander);  // creased here, smooth there
  return strength * (0.007 * ridge(13 * s - 21 * t + 1.7 * wander) +
                     0.005 * ridge(24 * s + 15 * t - 1.4 * wander + 0.8));
}

}  // namespace

SceneMesh make_drape(int detail) {
  const ClothOptions options;
  const std::vector<Eigen::Vector3f> nodes = fallen_cloth(options);
  const GridShape shape{9 * detail / 4, 9 * detail / 4, false};
  return parametric_grid(shape, [&](double s, double t) {
    const Eigen::Vector3d smooth = spline_point(nodes, options.nodes, s, t);
    const Eigen::Vector3d outward(smooth.x(), 0.35 * smooth.y(), smooth.z());
    return SurfacePoint{smooth + crease(s, t) * outward.normalized(), flat_point(options, s, t)};
  });
}

}  // namespace rakelight
