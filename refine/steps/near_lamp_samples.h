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
  Eigen::ArrayX3d I;  ///< radiance, a row a pixel
  Eigen::ArrayX3d w;  ///< trust in it, 0 to 1
  Eigen::Matrix<double, Eigen::Dynamic, kHighlightLobes>
      lobes;  ///< highlights of its lamp where it stood when sampled
};

struct LampRegion {
  std::vector<BroadPixel> pixels;
  std::vector<RegionImage> images;
};

constexpr int kLampRegions = 12;

/// About `pixels` pixels of the surface in kLampRegions regions of about equal size: bands of rows, each cut into columns.
/// Their weights are the state's.
/// @param shape nullptr: the surface is held
std::vector<LampRegion> sample_lamp_regions(const Observations& images, const BroadShape* shape,
                                            const SurfaceState& state, int pixels);

/// Weighs all usable samples anew by how far the state, its albedo fitted, and the gloss miss them: (1 + (r / scale)^2)^-2,
/// scale a robust deviation of the image's residuals. That all but forgets shadows, while a share of the many samples in
/// shadow would turn the lamps; a start that is far off it would hold where it is.
void forget_shadows(const SurfaceState& state, const Gloss& gloss, std::vector<LampRegion>& regions);

}  // namespace rakelight
