// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From raw depth frames to the start z0 (Sec. III, first paragraph): frames merged, holes inpainted, bilateral filter;
// and the sensor's noise, measured.
#pragma once

#include "refine/options.h"
#include "stack/stack.h"

namespace rakelight {

/// The sensor's depth on the registered depth grid (refine/steps/registration.h).
struct SensorDepth {
  Camera camera;
  cv::Mat1b mask;       ///< 255 = object
  cv::Mat1f measured;   ///< metres, all frames merged; NaN = no reading or outside the mask
  cv::Mat1f smooth;     ///< metres, z0: inpainted and filtered; NaN outside the mask
  cv::Mat1b inpainted;  ///< 255 where z0 had no reading
  double noise_m = 0;   ///< standard deviation of one merged reading, metres
  int frames = 0;       ///< depth frames merged
};

/// @param mask on the registered depth grid. @throws InputError when no pixel of it has depth.
SensorDepth preprocess_depth(const LightStack& stack, const cv::Mat1b& mask,
                             const PreprocessOptions& options);

/// Median over the frames' readings a pixel; NaN where fewer than a third of the frames (at least one) see something.
cv::Mat1f merge_depth_frames(const std::vector<cv::Mat1f>& frames);

/// Deviation of one reading, metres: robust spread of the difference to a local plane, at least the quantisation's.
double measure_depth_noise(const cv::Mat1f& depth, double depth_unit_m);

/// Fills `holes` of a depth map from their surroundings (Bertalmio's inpainting, as the paper's [2]).
cv::Mat1f inpaint_depth(const cv::Mat1f& depth, const cv::Mat1b& holes);

/// Bicubic log-depth on a grid `scale` times finer; NaN-free input inside, values outside the mask are extended.
cv::Mat1f upsample_log_depth(const cv::Mat1f& depth, int scale);

}  // namespace rakelight
