// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A picture to draw into that no window shows.
#pragma once

#include <opencv2/core.hpp>

#include "viewer/gl/gl_object.h"

namespace rakelight {

/// Colour and depth, four samples a pixel.
class Framebuffer {
 public:
  /// Becomes the target of drawing. @throws std::system_error if the driver cannot hold it
  explicit Framebuffer(const cv::Size& size);

  const cv::Size& size() const { return size_; }
  /// Makes it the target of drawing again.
  void bind() const;
  /// What was drawn, R G B, top row first.
  cv::Mat3b read() const;
  /// Puts what was drawn into the window, which becomes the target of drawing. The window is of the same size.
  void show_in_window() const;

 private:
  void resolve() const;

  cv::Size size_;
  GlObject color_, depth_, drawn_, resolved_color_, resolved_;
};

/// Makes the window the target of drawing, all black.
void clear_window();

/// Whether the current context draws on the processor: then every sample of every triangle counts.
bool is_software_renderer();

/// The pixels of the framebuffer that is bound for reading, R G B, top row first.
cv::Mat3b read_pixels(const cv::Size& size);

}  // namespace rakelight
