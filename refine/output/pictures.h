// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures in which a person sees what the refinement did.
#pragma once

#include <opencv2/core.hpp>

#include "refine/refine.h"

namespace rakelight {

/// The surface as grey plaster under a lamp that grazes it from the upper left; black where there is none.
/// @param normals camera frame, unit length, NaN outside
cv::Mat1b raking_light(const cv::Mat3f& normals);

/// The smallest box around the pixels that have depth, with a margin of a few pixels; the whole picture if none has.
cv::Rect object_box(const cv::Mat1f& depth);

/// Sensor depth left of refined depth, in raking light and as normals. R, G, B; cropped to the object, each of the four
/// pictures at most some 1000 pixels wide and high.
cv::Mat3b before_after_picture(const RefineResult& result);

}  // namespace rakelight
