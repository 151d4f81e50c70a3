// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The albedo of one image. A pixel's colour alone does not tell paint from shading, so the albedo is asked to be
// smooth except where the colours change, on a_c = log rho_c:
//
//     min sum_p w_p (a_p - log(I_p / S_p))^2 + m_p (a_p - palette_p)^2 + lambda sum_(p,q) v_pq (a_p - a_q)^2
//     v_pq = max(floor, exp(-|log I_p - log I_q|^2 / (2 sigma^2)))            over all three channels jointly
#pragma once

#include "refine/observations.h"
#include "refine/options.h"
#include "refine/solver/depth_solver.h"
#include "refine/surface_state.h"

namespace rakelight {

/// v_pq of the steps right and down, [pixel]; 0 where there is no neighbour.
struct EdgeWeights {
  std::vector<double> right, down;
};

/// From one image (image 0 of `image`): dark values count as `kDarkest` of the brightest.
EdgeWeights color_edge_weights(const PixelGrid& grid, const Observations& image,
                               const AlbedoOptions& options);

/// Smooth log albedo of one image and what it is pulled to.
class AlbedoSmoother {
 public:
  /// @param grid, image must outlive this
  AlbedoSmoother(const PixelGrid& grid, const Observations& image, const AlbedoOptions& options,
                 Solver solver);

  /// Albedo (3 x pixels) under the state's normals and lamps. @return false when the system is singular.
  bool estimate(const SurfaceState& state, Eigen::Matrix3Xf& albedo);

 private:
  /// @param log_albedo where to start, and the solution
  bool solve(const Eigen::VectorXd& weight, const Eigen::Matrix3Xd& weighted_target,
             Eigen::Matrix3Xd& log_albedo);

  const PixelGrid& grid_;
  const Observations& image_;
  AlbedoOptions options_;
  EdgeWeights edges_;
  DepthCells cells_;  ///< of one pixel each
  std::unique_ptr<DepthSolver> solver_;
  Eigen::Matrix3Xd log_albedo_;  ///< of the last estimate
};

}  // namespace rakelight
