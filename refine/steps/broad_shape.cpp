// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/broad_shape.h"

#include <cmath>

#include "refine/pixel_blocks.h"

namespace rakelight {

namespace {

/// Relative to it, the unknowns are well scaled.
double zeta_of_center(const SurfaceState& state) {
  return std::log(static_cast<double>(state.scene.center.z()));
}

/// B at pixel p.
BroadChanges broad_changes(const SurfaceState& state, double zeta_center, int p) {
  const float x = state.points(0, p) / state.points(2, p), y = state.points(1, p) / state.points(2, p);
  BroadChanges B;
  B << 1, x, y, x * x, x * y, y * y, static_cast<float>(state.zeta[p] - zeta_center);
  return B;
}

}  // namespace

Eigen::VectorXd broad_change(const SurfaceState& state, const Eigen::Matrix<double, kBroadChanges, 1>& c) {
  Eigen::VectorXd change(state.zeta.size());
  const double zeta_center = zeta_of_center(state);
  for_each_block(static_cast<int>(change.size()), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) change[p] = broad_changes(state, zeta_center, p).cast<double>().dot(c);
  });
  return change;
}

BroadPixel broad_pixel(const BroadShape& shape, const SurfaceState& state, int p) {
  BroadPixel pixel;
  const Eigen::Vector3f normal = state.normals.col(p);
  pixel.B = broad_changes(state, zeta_of_center(state), p);
  // raw normal (fx zeta_u, fy zeta_v, -1 - u~ zeta_u - v~ zeta_v) = (zeta_x, zeta_y, -1 - x zeta_x - y zeta_y) by x, y
  const float x = pixel.B[1], y = pixel.B[2];
  const float d = -1.0f / normal.dot(Eigen::Vector3f(x, y, 1));
  const Eigen::Vector3f raw = d * normal;
  Eigen::Matrix<float, 2, kBroadChanges> gradient;
  gradient << 0, 1, 0, 2 * x, y, 0, raw.x(),  //
      0, 0, 1, 0, x, 2 * y, raw.y();
  Eigen::Matrix<float, 3, 2> J;
  J << 1, 0, 0, 1, -x, -y;
  J /= d;
  pixel.normal_by_c = (J - normal * (normal.transpose() * J)) * gradient;
  const int cell = shape.prior.cells.cell_of[static_cast<size_t>(p)];
  const auto size = static_cast<double>(shape.prior.cells.of(cell).size());
  pixel.prior_weight = shape.prior.cell_weight[static_cast<Eigen::Index>(cell)] / size;
  pixel.prior_miss = state.zeta[p] - shape.prior.cell_target[static_cast<Eigen::Index>(cell)];
  return pixel;
}

}  // namespace rakelight
