// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The letters of the viewer.
#pragma once

namespace rakelight {

/// Loads the system's DejaVu Sans, or where it is not installed Dear ImGui's own font. @param height_px of a line
void load_font(float height_px);

}  // namespace rakelight
