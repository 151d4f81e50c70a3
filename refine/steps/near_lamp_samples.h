// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the joint lamp fit looks at: pixels spread evenly over the surface, by regions of the picture. All is planar, a row a
// pixel; the rows past a region's last pixel repeat it and carry no weight.
#pragma once

#include <vector>

#include "refine/observations.h"
#include "refine/steps/broad_shape.h"
#include "refine/steps/near_lamp_incidence.h"
#include "refine/steps/near_lamp_unknowns.h"

namespace rakelight {

/// Column of channel c of an image.
inline Eigen::Index sample_column(size_t image, int c) { return 3 * static_cast<Eigen::Index>(image) + c; }

/// The images at a region's pixels.
struct RegionSamples {
  std::vector<int> pixels;
  Eigen::ArrayXXf I;       ///< radiance, columns by sample_column
  Eigen::ArrayXXf usable;  ///< 1 or 0

  Eigen::Index rows() const { return I.rows(); }
};

constexpr int kLampRegions = 12;
constexpr int kLampPixels = 4000;

/// About `pixels` pixels of the surface in kLampRegions regions of about equal size: bands of rows, each cut into columns.
/// Which pixels these are does not change with the surface, so one choice serves all fits.
std::vector<RegionSamples> sample_lamp_regions(const Observations& images, const SurfaceState& state,
                                               int pixels = kLampPixels);

/// A region as a fit sees it: its samples, the surface there and how it may change, and the trust in each sample.
struct LampRegion {
  const RegionSamples* samples;
  SurfacePoints surface;
  Eigen::ArrayXXf B;            ///< d zeta / d c, a column a broad change
  Eigen::ArrayXXf normal_by_c;  ///< d n / d c, columns kBroadChanges * coordinate + change
  Eigen::ArrayXd prior_weight;  ///< lambda_z; 0 past the last pixel
  Eigen::ArrayXd prior_miss;    ///< zeta - z0
  Eigen::ArrayXXf w;            ///< trust in the samples, 0 to 1, columns by sample_column
  Eigen::ArrayXXf lobes;        ///< highlights of each lamp where it stood when the region was made, columns
                                ///< kHighlightLobes * image + lobe
};

/// The regions at the state's surface, lamps and weights.
/// @param samples must outlive the regions  @param shape nullptr: the surface is held
std::vector<LampRegion> lamp_regions(const std::vector<RegionSamples>& samples, const BroadShape* shape,
                                     const SurfaceState& state);

}  // namespace rakelight
