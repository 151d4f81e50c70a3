// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/residual_draws.h"

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

/// What images and albedo add up to at one pixel.
struct PixelSums {
  DrawnPulls q = DrawnPulls::Zero();                 ///< sum factor w rho l r, r = I - rho S
  DrawnPulls Sr = DrawnPulls::Zero();                ///< sum factor w S r
  Eigen::Matrix3f by_rho = Eigen::Matrix3f::Zero();  ///< column c: sum w l (r - rho S), the change by rho_c
  Eigen::Vector3f SS = Eigen::Vector3f::Zero();      ///< sum w S^2

  DrawnPulls pull() const { return q + by_rho * SS.cwiseMax(1e-8f).cwiseInverse().asDiagonal() * Sr; }
};

void add_image(const Observations& images, const SurfaceState& state, int i, int p,
               const DrawFactors& factors, PixelSums& sums) {
  const auto at = static_cast<size_t>(i) * static_cast<size_t>(images.pixels) + static_cast<size_t>(p);
  const float w = state.weight[at];
  if (w == 0.0f) return;
  const Eigen::Vector3f n = state.normals.col(p), rho = state.albedo.col(p),
                        usable = images.usable_channels(i, p);
  const LocalLight light = light_at(state.lamps[static_cast<size_t>(i)], state.points.col(p), n, state.scene);
  const Eigen::Vector3f lit = light.l * n, S = usable.cwiseProduct(shading(light, n, state.attached_shadows));
  const Eigen::Vector3f r = usable.cwiseProduct(images.radiance_at(i, p)) - rho.cwiseProduct(S);
  Eigen::Vector3f lr = Eigen::Vector3f::Zero();
  for (int c = 0; c < 3; ++c) {
    if (usable[c] == 0.0f || (state.attached_shadows && lit[c] <= 0.0f)) continue;
    const Eigen::Vector3f l = w * light.l.row(c).transpose();
    sums.by_rho.col(c) += (r[c] - rho[c] * S[c]) * l;
    lr += rho[c] * r[c] * l;
  }
  sums.SS += w * S.cwiseAbs2();
  sums.q.noalias() += lr * factors.row(i);
  sums.Sr.noalias() += (w * S.cwiseProduct(r)) * factors.row(i);
}

}  // namespace

std::vector<DrawnPulls> pulls_of_scaled_residuals(const Observations& images, const SurfaceState& state,
                                                  const DrawFactors& factors) {
  std::vector<DrawnPulls> pulls(static_cast<size_t>(images.pixels));
  constexpr int kRun = 512;  // pixels whose sums stay in the cache
  for_each_block(images.pixels, [&](int block, int block_end) {
    for (int begin = block; begin < block_end; begin += kRun) {
      const int end = std::min(begin + kRun, block_end);
      std::vector<PixelSums> sums(static_cast<size_t>(end - begin));
      for (int i = 0; i < images.images; ++i)
        for (int p = begin; p < end; ++p)
          add_image(images, state, i, p, factors, sums[static_cast<size_t>(p - begin)]);
      for (int p = begin; p < end; ++p)
        pulls[static_cast<size_t>(p)] = sums[static_cast<size_t>(p - begin)].pull();
    }
  });
  return pulls;
}

Eigen::MatrixXd right_hand_sides(const DepthProblem& depth, const Eigen::VectorXd& zeta,
                                 const std::vector<DrawnPulls>& pulls) {
  Eigen::Matrix<double, Eigen::Dynamic, kDrawsAtATime, Eigen::RowMajor> rhs =
      decltype(rhs)::Zero(depth.grid.size(), kDrawsAtATime);
  for (int p = 0; p < depth.grid.size(); ++p) {
    const auto at = static_cast<size_t>(p);
    const NormalFrame frame = normal_frame(depth.grid, p);
    for (int k = 0; k < kCorners; ++k) {
      if (!depth.corners.has(p, k)) continue;
      const Corner corner = corner_at(depth.grid, p, k);
      const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
      const Eigen::Vector3f raw = frame.raw(g.x(), g.y()), n = raw.normalized();
      const Eigen::Matrix<float, 3, 2> J = frame.jacobian() / raw.norm();
      const Eigen::Matrix<float, 3, 2> dn = J - n * (n.transpose() * J);
      const Eigen::Matrix<double, 2, kDrawsAtATime> pull =
          (depth.corner_weight[at][static_cast<size_t>(k)] * dn.transpose() * pulls[at]).cast<double>();
      const Eigen::Matrix<double, 1, kDrawsAtATime> x = static_cast<double>(corner.x_sign) * pull.row(0),
                                                    y = static_cast<double>(corner.y_sign) * pull.row(1);
      rhs.row(corner.x_neighbor) += x;
      rhs.row(corner.y_neighbor) += y;
      rhs.row(p) -= x + y;
    }
  }
  return rhs;
}

}  // namespace rakelight
