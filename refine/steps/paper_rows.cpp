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
    for (const auto& [c, k] : kPairs) {
      const Eigen::Vector3f v =
          rho[k] * (image.channel(0, c)[p] - rho[c] * lamp.phi[c]) * lamp.l.row(k).transpose() -
          rho[c] * (image.channel(0, k)[p] - rho[k] * lamp.phi[k]) * lamp.l.row(c).transpose();
      rows.push_back({p, (frame.jacobian().transpose() * v).cast<double>(), static_cast<double>(v[2])});
    }
  }
  return rows;
}

Eigen::Matrix3Xf orthographic_normals(const CornerList& corners, const Eigen::VectorXd& z, double k) {
  Eigen::Matrix3Xf normals(3, z.size());
  for (int p = 0; p < static_cast<int>(z.size()); ++p) {
    const Eigen::Vector2d g = k * forward_gradient(corners, p, z);
    normals.col(p) = Eigen::Vector3d(g.x(), g.y(), -1).normalized().cast<float>();
  }
  return normals;
}

std::vector<GradientRow> shading_rows(const CornerList& corners, const Eigen::Vector4d& s,
                                      const Eigen::VectorXd& rho, const Eigen::VectorXd& I,
                                      const Eigen::VectorXd& z, double k) {
  std::vector<GradientRow> rows;
  for (int p = 0; p < static_cast<int>(z.size()); ++p) {
    const double d = std::sqrt(1 + (k * forward_gradient(corners, p, z)).squaredNorm());
    rows.push_back({p, rho[p] * k / d * s.head<2>(), I[p] - rho[p] * s[3] + rho[p] * s[2] / d});
  }
  return rows;
}

}  // namespace rakelight
