// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The changes of a surface that light from unknown directions leaves open (the bas-relief ambiguity): zeta + B c with B
// the columns 1, x, y, x^2, xy, y^2 and zeta, where (x, y, 1) z is the point. The lamps' fit carries them along.
#pragma once

#include "refine/kernels/near_lamp_kernels.h"
#include "refine/steps/super_resolution.h"
#include "refine/surface_state.h"

namespace rakelight {

constexpr int kBroadChanges = kernels::kBroadChanges;
using BroadChanges = Eigen::Matrix<float, 1, kBroadChanges>;

/// The surface that the lamps are fitted with, and what holds it.
struct BroadShape {
  const PixelGrid& grid;
  const DepthPrior& prior;
};

/// How the broad changes move one surface point, and what holds it.
struct BroadPixel {
  BroadChanges B;                                      ///< d zeta / d c
  Eigen::Matrix<float, 3, kBroadChanges> normal_by_c;  ///< d n / d c
  double prior_weight = 0;                             ///< lambda_z of the pixel
  double prior_miss = 0;                               ///< zeta - z0
};

/// B c at every pixel: the change of zeta.
Eigen::VectorXd broad_change(const SurfaceState& state, const Eigen::Matrix<double, kBroadChanges, 1>& c);

BroadPixel broad_pixel(const BroadShape& shape, const SurfaceState& state, int p);

}  // namespace rakelight
