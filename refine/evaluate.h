// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distance of a refined depth map from the truth, as in Sec. IV (RMSE and MAE of Table II).
#pragma once

#include "stack/stack.h"

namespace rakelight {

/// Errors over the pixels where truth and depth both exist.
struct Evaluation {
  double rmse_mm = 0;           ///< root mean square depth error
  double rmse_unbiased_mm = 0;  ///< the same after removing the mean error
  double mae_deg = 0;  ///< mean angle to the true normal, of normals from depth by forward differences
  double median_deg = 0;
  double own_normals_mae_deg = 0;  ///< of the normals given, NaN without
  double completeness = 0;         ///< share of truth pixels that have depth
};

/// @param camera of the depth grid  @param depth metres, NaN = none  @param normals may be empty
/// Grids of different size are compared on the finer one. @throws InputError when the sizes have no integer ratio.
Evaluation evaluate(const Camera& camera, const cv::Mat1f& depth, const cv::Mat3f& normals,
                    const GroundTruth& truth);

/// Errors pixel by pixel, on the finer grid; NaN where truth or depth is missing.
struct ErrorMaps {
  Camera camera;            ///< of that grid
  double mean_depth_m = 0;  ///< of the pixels compared
  cv::Mat1f depth_mm;       ///< depth minus truth
  cv::Mat1f normal_deg;     ///< angle between the true normal and that of depth by forward differences
};

/// Parameters and errors as in evaluate.
ErrorMaps error_maps(const Camera& camera, const cv::Mat1f& depth, const GroundTruth& truth);

/// How honest a result's error bars are: the share of errors inside one standard deviation, 0.68 for perfect ones.
struct ErrorBarReport {
  double depth_within =
      0;  ///< depth errors, their median removed: the mean is that of a few pixels at occlusions
  double normal_within = 0;  ///< angles between the result's normals and the true ones
};

/// @param uncertainty deviation of depth (m) and of the normal (rad), as in RefineResult; the rest as in evaluate.
ErrorBarReport evaluate_error_bars(const Camera& camera, const cv::Mat1f& depth, const cv::Mat3f& normals,
                                   const cv::Mat3f& uncertainty, const GroundTruth& truth);

}  // namespace rakelight
