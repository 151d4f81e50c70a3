// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a depth map errs, and which way.
#pragma once

#include <opencv2/core.hpp>

namespace rakelight {

/// The colour of signed values, in pictures, plots and the viewer alike: from blue (-1 and below) over white (0) to red (1
/// and above). R, G, B. @param share of the range
cv::Vec3b signed_color(float share);

/// The first of 1, 2 or 5 times a power of ten (at least 0.001) that this share of the absolute values does not exceed;
/// NaN does not count.
double round_range(const cv::Mat1f& values, double share);

/// Errors as colours: blue = negative, white = 0, red = positive, full colour at `range` and beyond; black where NaN.
/// R, G, B. @param range in the unit of the errors
cv::Mat3b error_colors(const cv::Mat1f& errors, double range);

/// The range of colours that shows `depth`'s errors well: 1, 2 or 5 times a power of ten (mm), at least their 90th
/// percentile. @param depth, truth metres, NaN = none, sizes as in error_map
double error_range_mm(const cv::Mat1f& depth, const cv::Mat1f& truth);

/// depth - truth as colours: blue = too near, white = right, red = too far, full colour at `range_mm` and beyond; black
/// where either is missing. R, G, B. @param truth metres; on a grid of another size the nearest pixel counts
cv::Mat3b error_map(const cv::Mat1f& depth, const cv::Mat1f& truth, double range_mm);

/// The scale of error_map: its colours from -range to +range with numbers, `width` x 26 pixels.
cv::Mat3b error_scale(int width, double range_mm);

}  // namespace rakelight
