// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles between the pixels of a depth map.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

/// Joins neighbouring pixels unless a depth jump lies between them; counter-clockwise seen from the camera.
/// @param depth metres, on the camera's grid
/// @param stride pixels between those that are joined: only every stride-th row and column counts
/// @param vertex_index the number of each pixel's vertex, -1 where there is none; triangles name vertices by it
std::vector<std::array<int, 3>> triangulate(const Camera& camera, const cv::Mat1f& depth,
                                            const cv::Mat1i& vertex_index, int stride = 1);

}  // namespace rakelight
