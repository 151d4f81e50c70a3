// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The window: events in, pictures out. What they mean is in viewer/commands.h and viewer/mouse.h.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "viewer/viewer.h"

namespace rakelight {

class ViewerWindow {
 public:
  /// @throws std::system_error without a display or OpenGL 3.3
  ViewerWindow(const std::string& title, const cv::Size& size);
  ~ViewerWindow();
  ViewerWindow(const ViewerWindow&) = delete;
  ViewerWindow& operator=(const ViewerWindow&) = delete;

  /// Shows another scene from a view point. @throws InputError if it has no surface that can be drawn
  void show(Scene scene, const Look& look, const ViewPoint& view, bool light_follows_mouse);

  /// The same object, moved on: look and camera stay. @throws as show
  void update(Scene scene);

  /// Two pictures beside each other instead of a scene: colour and depth as they come from a sensor; either may be empty.
  void show_pictures(const cv::Mat3b& color, const cv::Mat3b& depth);

  void set_status(const std::string& text);

  /// Waits for events, at most so long (seconds), handles them and draws. @return false once the window is to close
  /// @throws std::system_error if the display went away
  bool step(double most_wait);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rakelight
