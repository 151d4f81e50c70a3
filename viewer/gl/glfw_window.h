// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A GLFW window with a current OpenGL 3.3 core context.
#pragma once

#include <memory>
#include <string>

struct GLFWwindow;

namespace rakelight {

struct GlfwWindowDeleter {
  void operator()(GLFWwindow* window) const;  ///< ends GLFW, too: the program has one window at a time
};
using GlfwWindowPtr = std::unique_ptr<GLFWwindow, GlfwWindowDeleter>;

/// Without samples: what needs them draws into a Framebuffer.
/// @throws std::system_error when there is no display or no OpenGL 3.3
GlfwWindowPtr make_glfw_window(const std::string& title, int width, int height, bool visible);

}  // namespace rakelight
