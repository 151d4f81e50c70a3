// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The clicked points, the line between them and its length, over the drawing.
#pragma once

#include <opencv2/core.hpp>

#include "viewer/view_state.h"

namespace rakelight {

/// @param size of the drawing, in Dear ImGui's units
void draw_marks(const ViewState& state, const cv::Size2f& size);

}  // namespace rakelight
