// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/residual_draws.h"

#include <algorithm>
#include <memory>
#include <opencv2/core/utility.hpp>

#include "refine/tiles.h"

namespace rakelight {
namespace {

using kernels::TileDraws;

/// q + by_rho Sr / SS of one pixel of a tile.
DrawnPulls pull_at(const TileDraws& sums, int p) {
  DrawnPulls pull;
  Eigen::Matrix3f by_rho;  // column c: a unit of drho_c's, over the albedo's own equation
  for (int c = 0; c < 3; ++c)
    for (int axis = 0; axis < 3; ++axis)
      by_rho(axis, c) = sums.by_rho[c][axis].at[p] / std::max(1e-8f, sums.SS[c].at[p]);
  for (int draw = 0; draw < kDrawsAtATime; ++draw) {
    const Eigen::Vector3f q(sums.q[0][draw].at[p], sums.q[1][draw].at[p], sums.q[2][draw].at[p]),
        Sr(sums.Sr[0][draw].at[p], sums.Sr[1][draw].at[p], sums.Sr[2][draw].at[p]);
    pull.col(draw) = q + by_rho * Sr;
  }
  return pull;
}

/// What the corners of pixel p make of its pulls, added to its row and its neighbours'.
void add_pixel(const DepthProblem& depth, const Eigen::VectorXd& zeta, int p, const DrawnPulls& pulls,
               DrawnSides& rhs) {
  const NormalFrame frame = normal_frame(depth.grid, p);
  for (int k = 0; k < kCorners; ++k) {
    if (!depth.corners.has(p, k)) continue;
    const Corner corner = corner_at(depth.grid, p, k);
    const Eigen::Vector2f g = corner_gradient(corner, p, zeta);
    const Eigen::Vector3f raw = frame.raw(g.x(), g.y()), n = raw.normalized();
    const Eigen::Matrix<float, 3, 2> J = frame.jacobian() / raw.norm();
    const Eigen::Matrix<float, 3, 2> dn = J - n * (n.transpose() * J);
    const float weight = depth.corner_weight[static_cast<size_t>(p)][static_cast<size_t>(k)];
    const Eigen::Matrix<double, 2, kDrawsAtATime> pull = (weight * dn.transpose() * pulls).cast<double>();
    const Eigen::Matrix<double, 1, kDrawsAtATime> x = static_cast<double>(corner.x_sign) * pull.row(0),
                                                  y = static_cast<double>(corner.y_sign) * pull.row(1);
    rhs.row(corner.x_neighbor) += x;
    rhs.row(corner.y_neighbor) += y;
    rhs.row(p) -= x + y;
  }
}

/// First pixel of a row of the grid's box or of one below.
int first_pixel(const PixelGrid& grid, int row) {
  if (row >= grid.box.height) return grid.size();
  const auto run = static_cast<size_t>(grid.first_run[static_cast<size_t>(row)]);
  return run < grid.runs.size() ? grid.runs[run].first : grid.size();
}

/// Bands of rows side by side: every second one at a time, since a pixel adds to the rows above and below its own.
template <class Body>
void for_each_pixel_in_bands(const PixelGrid& grid, const Body& body) {
  constexpr int kRows = 16;
  const int bands = (grid.box.height + kRows - 1) / kRows;
  for (const int first : {0, 1}) {
    cv::parallel_for_(cv::Range(0, (bands - first + 1) / 2), [&](const cv::Range& range) {
      for (int k = range.start; k < range.end; ++k) {
        const int row = (2 * k + first) * kRows, end = first_pixel(grid, row + kRows);
        for (int p = first_pixel(grid, row); p < end; ++p) body(p);
      }
    });
  }
}

}  // namespace

std::vector<DrawnPulls> pulls_of_scaled_residuals(const Observations& images, const SurfaceState& state,
                                                  const DrawFactors& factors) {
  std::vector<DrawnPulls> pulls(static_cast<size_t>(images.pixels));
  const std::vector<kernels::TileLamp> lamps = tile_lamps(state);
  for_each_tile(images, state, [&](Tile& tile) {
    const auto sums = std::make_unique<TileDraws>();
    for (int i = 0; i < images.images; ++i) {
      float factor[kDrawsAtATime];
      for (int draw = 0; draw < kDrawsAtATime; ++draw) factor[draw] = factors(i, draw);
      kernels::add_residual_draws(tile.surface(), lamps[static_cast<size_t>(i)], tile.image(i), factor,
                                  *sums);
    }
    for (int p = 0; p < tile.count(); ++p) pulls[static_cast<size_t>(tile.begin() + p)] = pull_at(*sums, p);
  });
  return pulls;
}

DrawnSides right_hand_sides(const DepthProblem& depth, const Eigen::VectorXd& zeta,
                            const std::vector<DrawnPulls>& pulls) {
  DrawnSides rhs = DrawnSides::Zero(depth.grid.size(), kDrawsAtATime);
  for_each_pixel_in_bands(depth.grid,
                          [&](int p) { add_pixel(depth, zeta, p, pulls[static_cast<size_t>(p)], rhs); });
  return rhs;
}

}  // namespace rakelight
