// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings depth frames to the colour camera's view, where the refinement takes place.
#pragma once

#include "stack/stack.h"

namespace rakelight {

/// How many colour pixels lie along one depth pixel, 1 to 4 (the largest scale that colour can support).
int color_to_depth_ratio(const LightStack& stack);

/// The grid that depth is registered to: the colour camera, without distortion, binned by color_to_depth_ratio.
Camera registered_depth_camera(const LightStack& stack);

/// One depth frame in metres on that grid, NaN where there is no reading. Where the depth is already registered
/// (identity T_color_depth, same view), pixels are passed on as they are; else points are projected, nearest wins.
cv::Mat1f registered_depth(const LightStack& stack, const Frame& frame);

}  // namespace rakelight
