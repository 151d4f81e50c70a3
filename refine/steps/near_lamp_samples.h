// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the joint lamp fit looks at: pixels spread evenly over the surface, by regions of the picture.
#pragma once

#include <vector>

#include "refine/observations.h"
#include "refine/steps/broad_shape.h"
#include "refine/steps/near_lamp_unknowns.h"

namespace rakelight {

/// An image at a region's pixels.
struct RegionImage {
  Eigen::ArrayX3d I;                                   ///< radiance, a row a pixel
  Eigen::ArrayX3d w;                                   ///< trust in it, 0 to 1
  Eigen::Matrix<double, Eigen::Dynamic, kHighlightLobes> lobes;  ///< highlights of its lamp where it stood when sampled
};

struct LampRegion {
  std::vector<BroadPixel> pixels;
  std::vector<RegionImage> images;
};

constexpr int kLampRegions = 12;

/// About `pixels` pixels of the surface in kLampRegions regions of about equal size: bands of rows, each cut into columns.
/// Samples are trusted by how far they miss the fit's start, with weights (1 + (r / scale)^2)^-2 that all but forget
/// shadows: a share of the many samples in shadow would turn the lamps. @param shape nullptr: the surface is held
/// @param tolerance scale of the weights, in robust deviations of the residuals
std::vector<LampRegion> sample_lamp_regions(const Observations& images, const BroadShape* shape,
                                            const SurfaceState& state, const Gloss& gloss, double tolerance,
                                            int pixels);

}  // namespace rakelight
