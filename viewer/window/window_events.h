// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GLFW's callbacks as functions.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "viewer/mouse.h"

struct GLFWwindow;

namespace rakelight {

/// They are called from C code and must not throw. Positions are in window units from the upper left corner: where the
/// last event said the mouse was; asked for later, it might have moved on.
struct WindowEvents {
  std::function<void()> any;  ///< before each of the others, and when the window must be drawn anew
  std::function<void(const std::string& name)> key;  ///< as in viewer/commands.h
  std::function<void(MouseButton button, bool shift, const cv::Point2d& at)> press;
  std::function<void(const cv::Point2d&at)> release, move;
  std::function<void(double notches, const cv::Point2d& at)> scroll;
  std::function<void(const std::filesystem::path& path)> drop;

  cv::Point2d cursor;  ///< kept by the callbacks
};

/// @param events must outlive the window's events
void listen(GLFWwindow* window, WindowEvents& events);

}  // namespace rakelight
