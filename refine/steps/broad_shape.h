// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The changes of a surface that light from unknown directions leaves open (the bas-relief ambiguity): zeta + B c with B
// the columns 1, x, y, x^2, xy, y^2 and zeta, where (x, y, 1) z is the point. The lamps' fit carries them along.
#pragma once

#include "refine/steps/super_resolution.h"
#include "refine/surface_state.h"

namespace rakelight {

constexpr int kBroadChanges = 7;
using BroadChanges = Eigen::Matrix<float, 1, kBroadChanges>;

/// The surface that the lamps are fitted with, and what holds it.
struct BroadShape {
  const PixelGrid& grid;
  const DepthPrior& prior;
};

/// One surface point and how the broad changes move it.
struct BroadPixel {
  int p = 0;
  Eigen::Vector3f point, normal;          ///< at c = 0
  BroadChanges B = BroadChanges::Zero();  ///< d zeta / d c
  Eigen::Matrix<float, 3, kBroadChanges> normal_by_c =
      Eigen::Matrix<float, 3, kBroadChanges>::Zero();  ///< d n / d c
  double prior_weight = 0;                             ///< lambda_z of the pixel
  double prior_miss = 0;                               ///< zeta - z0
};

/// B at pixel p.
BroadChanges broad_changes(const SurfaceState& state, int p);

/// @param shape nullptr: the surface is held (B = 0, no prior)
BroadPixel broad_pixel(const BroadShape* shape, const SurfaceState& state, int p);

}  // namespace rakelight
