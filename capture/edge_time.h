// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where in time a lamp's edge lies, seen in the rows of a rolling shutter.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "capture/frame_gate.h"
#include "stack/stack.h"

namespace rakelight {

/// Mean linear radiance (sum of R, G, B) of bands of rows, from the first row to the last.
using RowProfile = std::vector<float>;
RowProfile row_profile(const cv::Mat& color, const ColorResponse& response);

/// The largest difference of two profiles over the bands.
float largest_difference(const RowProfile& a, const RowProfile& b);

struct ProfiledFrame {
  std::int64_t time_us = 0;  ///< of the last row's closing, device time
  RowProfile profile;
};

/// Device time between which an edge lies: equal where rows caught it.
struct EdgeTime {
  double earliest_us = 0, latest_us = 0;
};

/// When the light changed from `before` to `after`: a band whose exposure saw the share f of the new light closed
/// f * exposure after the edge. The median over all bands that saw a part of it; where none did, the edge fell between the
/// exposures of two frames (one of which may be lost). Nothing if no frame is on one side.
std::optional<EdgeTime> edge_time(const std::vector<ProfiledFrame>& frames, const RowProfile& before,
                                  const RowProfile& after, const FrameTiming& timing);

}  // namespace rakelight
