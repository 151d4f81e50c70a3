// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the unknowns of the joint lamp fit make of a region's samples: I = rho S + H, and how S changes with them.
#pragma once

#include "refine/steps/near_lamp_samples.h"
#include "refine/steps/near_lamp_unknowns.h"

namespace rakelight {

/// The region's surface as the broad changes move it.
SurfacePoints moved_surface(const NearLampUnknowns& at, const LampRegion& region);

/// Columns by sample_column where not said otherwise.
struct RegionModel {
  Eigen::ArrayXXf S;     ///< shading
  Eigen::ArrayXXf matt;  ///< I - H
  Eigen::ArrayX3f SS;    ///< a column a channel: sum w S^2
  Eigen::ArrayX3f
      rho;  ///< a column a channel: sum w S (I - H) / sum w S^2; 0 where that is negative or nothing is lit

  RegionModel(const NearLampUnknowns& at, const LampRegion& region, const SurfacePoints& surface);

  /// I - rho S - H of a sample's column.
  Eigen::ArrayXf residual(Eigen::Index column) const {
    return matt.col(column) - rho.col(column % 3) * S.col(column);
  }
};

/// A sample of channel c depends on these unknowns: 3 of its lamp's place, e_c, phi_c, then the shared ones.
constexpr Eigen::Index kOwnUnknowns = 5, kSampleUnknowns = kOwnUnknowns + NearLampUnknowns::kShared;

/// Columns of a ShadingDerivatives: S / e of a near lamp by its place, S / e itself, then by aim and shape.
constexpr Eigen::Index kByPlace = 0, kValue = 3, kByShared = 4,
                       kDerivatives = kByShared + NearLampUnknowns::kAim + NearLampUnknowns::kShape;
using ShadingDerivatives = Eigen::Array<float, Eigen::Dynamic, kDerivatives>;

ShadingDerivatives shading_derivatives(const Lamp& lamp, const LampScene& scene, const LampRegion& region,
                                       const SurfacePoints& surface);

}  // namespace rakelight
