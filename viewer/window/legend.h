// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scale bar and the names of what is shown, over the scene.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "viewer/color_map.h"
#include "viewer/look.h"

namespace rakelight {

/// Adds the legend to the frame of Dear ImGui that is being made. @param size of the drawing, in its units
void draw_legend(const std::optional<ColorRange>& range, const Look& look, const cv::Size2f& size);

/// Draws the legend where there is no window. Needs a current OpenGL context as long as it lives.
class OffscreenLegend {
 public:
  OffscreenLegend();
  ~OffscreenLegend();
  OffscreenLegend(const OffscreenLegend&) = delete;
  OffscreenLegend& operator=(const OffscreenLegend&) = delete;
  /// Over the bound framebuffer. @param size pixels
  void draw(const std::optional<ColorRange>& range, const Look& look, const cv::Size& size) const;
};

}  // namespace rakelight
