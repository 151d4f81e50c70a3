// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colour and depth as they come from a sensor, beside each other.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "viewer/window/filmstrip.h"

namespace rakelight {

class LivePictures {
 public:
  /// An empty picture leaves the last one.
  void set(const cv::Mat3b& color, const cv::Mat3b& depth);
  /// @param size of the drawing, in Dear ImGui's units
  void draw(const cv::Size2f& size) const;

 private:
  std::optional<PictureTexture> color_, depth_;
};

}  // namespace rakelight
