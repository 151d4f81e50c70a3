// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the unknowns of the joint lamp fit make of a region's pixels: I = rho S + H, and how S changes with them.
#pragma once

#include "refine/steps/near_lamp_samples.h"
#include "refine/steps/near_lamp_unknowns.h"

namespace rakelight {

/// A surface point as the broad changes move it.
struct MovedPoint {
  Eigen::Vector3f point, offset, normal;  ///< offset from the aim
};

std::vector<MovedPoint> moved_points(const NearLampUnknowns& at, const std::vector<BroadPixel>& pixels);

/// zeta - z0 of a pixel.
double prior_miss(const NearLampUnknowns& at, const BroadPixel& pixel);

/// S of an image, a row a pixel, a column a channel.
Eigen::ArrayX3d region_shading(const Lamp& lamp, const std::vector<MovedPoint>& points, float lobe_exponent);

/// Highlights of an image: strength * sum_j gloss_j lobe_j, the lobes held.
Eigen::ArrayX3d region_highlights(const Lamp& lamp, const RegionImage& image, const Gloss& gloss);

/// A sample of channel c depends on these unknowns: 3 of its lamp's place, e_c, phi_c, then the shared ones.
constexpr Eigen::Index kOwnUnknowns = 5, kSampleUnknowns = kOwnUnknowns + NearLampUnknowns::kShared;
using SampleDerivatives = Eigen::Matrix<double, Eigen::Dynamic, kSampleUnknowns, Eigen::RowMajor>;

/// Change of a near lamp's S / e with place, aim and shape, S / e itself for e, 1 for phi, 0 for the gloss; a row a pixel.
SampleDerivatives shading_derivatives(const Lamp& lamp, const std::vector<MovedPoint>& points,
                                      const std::vector<BroadPixel>& pixels, float lobe_exponent);

}  // namespace rakelight
