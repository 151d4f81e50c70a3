// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The still pictures of the report.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "refine/refine.h"

namespace rakelight {

/// JPEG data: URIs by the names that page.html has for them: relief, normals (each _before and _after), albedo, delta.
/// @param sensor_normals of result.initial_depth, in the box alone  @param box the object, pixels  @param side longest, pixels
/// @param range_mm at which delta has its full colour
std::map<std::string, std::string> report_pictures(const RefineResult& result,
                                                   const cv::Mat3f& sensor_normals, const cv::Rect& box,
                                                   int side, double range_mm);

/// Refined minus sensor depth: `range_mm`, counts in `bins` equal parts of [-range, range], pixels below and above,
/// mean and root mean square (mm).
nlohmann::ordered_json delta_histogram(const RefineResult& result, double range_mm, int bins);

}  // namespace rakelight
