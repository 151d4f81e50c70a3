// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scene on a grid some 80 cells wide: enough to tell where light comes from and what is object.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

/// Geometry on a coarse depth grid, colour-camera coordinates.
struct CoarseScene {
  cv::Size size;
  int cell = 1;        ///< depth pixels a cell, each way
  cv::Mat3f points;    ///< metres; NaN without reading
  cv::Mat3f normals;   ///< unit, towards the camera; NaN without
  cv::Mat2f color_uv;  ///< where the cell is seen in the colour image, 0 to 1 each way; NaN outside
};

/// @param depths frames of one still scene; the mean of their readings counts  @param stack cameras and units only
CoarseScene coarse_scene(const LightStack& stack, const std::vector<cv::Mat1w>& depths);

/// The colour image's linear radiance at the cells; 0 where a cell is not seen.
cv::Mat3f at_cells(const CoarseScene& scene, const cv::Mat& color, const ColorResponse& response);

/// Where a colour image is saturated in any channel: the share of each cell, 0 to 1.
cv::Mat1f saturated_cells(const CoarseScene& scene, const cv::Mat& color);

}  // namespace rakelight
