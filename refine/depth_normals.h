// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of a depth map as it is, for measuring and for pictures (the solver has its own stencil).
#pragma once

#include "stack/stack.h"

namespace rakelight {

/// Normals by forward differences of log depth (Eq. 5), backward at borders of the valid pixels; camera frame, unit
/// length, n_z < 0 faces the camera; NaN where depth is not a positive number.
/// @param depth metres, on the camera's grid
cv::Mat3d normals_from_depth(const Camera& camera, const cv::Mat1f& depth);

/// The same in a part of the grid alone, whose borders count as the surface's.
cv::Mat3f normals_in(const cv::Rect& part, const Camera& camera, const cv::Mat1f& depth);

}  // namespace rakelight
