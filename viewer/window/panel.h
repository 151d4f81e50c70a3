// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The controls beside the drawing, and the page of keys.
#pragma once

#include "viewer/view_state.h"

namespace rakelight {

/// Adds the panel to the frame of Dear ImGui that is being made, and does what is chosen there.
void draw_panel(ViewState& state, const Scene& scene);

/// The table of key_commands() and what the mouse does.
void draw_keys_page(ViewState& state);

/// The status line at the lower left. @param size of the drawing, in Dear ImGui's units
void draw_status(const ViewState& state, const cv::Size2f& size);

}  // namespace rakelight
