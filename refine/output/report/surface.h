// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface as the report's viewer draws it: a coarse height map with finer normals.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "refine/refine.h"

namespace rakelight {

/// Depth before and after as base64 of 16-bit codes, normals of both as one grey picture (surface.js reads them).
/// @param sensor_normals of result.initial_depth, in the box alone  @param box the object, pixels
/// @param samples about how many heights  @param side of the normals' pictures at most, pixels
nlohmann::ordered_json report_surface(const RefineResult& result, const cv::Mat3f& sensor_normals,
                                      const cv::Rect& box, int samples, int side);

}  // namespace rakelight
