// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/paper_rows.h"

#include <array>
#include <cmath>

namespace rakelight {
namespace {

constexpr std::array<std::array<int, 2>, 3> kPairs{{{0, 1}, {1, 2}, {2, 0}}};

}  // namespace

std::vector<GradientRow> ratio_rows(const PixelGrid& grid, const Observations& image,
                                    const SurfaceState& state) {
  const Lamp& lamp = state.lamps.front();
  std::vector<GradientRow> rows;
  for (int p = 0; p < image.pixels; ++p) {
    const auto frame = normal_frame(grid, p);
    const Eigen::Vector3f rho = state.albedo.col(p);
    const LocalLight light = light_at(lamp, state.points.col(p), state.normals.col(p), state.scene);
    for (const auto& [c, k] : kPairs) {
      const Eigen::Vector3f v =
          rho[k] * (image.channel(0, c)[p] - rho[c] * light.phi[c]) * light.l.row(k).transpose() -
          rho[c] * (image.channel(0, k)[p] - rho[k] * light.phi[k]) * light.l.row(c).transpose();
      rows.push_back({p, (frame.jacobian().transpose() * v).cast<double>(), static_cast<double>(v[2])});
    }
  }
  return rows;
}

Eigen::Matrix3Xf orthographic_normals(const PixelGrid& grid, const CornerList& corners,
                                      const Eigen::VectorXd& z, double k) {
  Eigen::Matrix3Xf normals(3, z.size());
  for (int p = 0; p < static_cast<int>(z.size()); ++p) {
    const Eigen::Vector2d g = k * forward_gradient(grid, corners, p, z);
    normals.col(p) = Eigen::Vector3d(g.x(), g.y(), -1).normalized().cast<float>();
  }
  return normals;
}

std::vector<GradientRow> shading_rows(const PixelGrid& grid, const CornerList& corners, const Lamp& lamp,
                                      const Eigen::VectorXd& rho, const Eigen::VectorXd& I,
                                      const Eigen::VectorXd& z, double k) {
  const Eigen::Matrix3Xf normals = orthographic_normals(grid, corners, z, k);
  std::vector<GradientRow> rows;
  for (int p = 0; p < static_cast<int>(z.size()); ++p) {
    const double d = std::sqrt(1 + (k * forward_gradient(grid, corners, p, z)).squaredNorm());
    const LocalLight light = light_at(lamp, Eigen::Vector3f::Zero(), normals.col(p), LampScene{});
    const Eigen::Vector3d l = light.l.row(0).transpose().cast<double>();
    const double phi = static_cast<double>(light.phi[0]);
    rows.push_back({p, rho[p] * k / d * l.head<2>(), I[p] - rho[p] * phi + rho[p] * l[2] / d});
  }
  return rows;
}

}  // namespace rakelight
