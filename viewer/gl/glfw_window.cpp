// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/glfw_window.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <system_error>

#include "viewer/gl/display_loss.h"
#include "viewer/gl/gl_object.h"

namespace rakelight {
namespace {

/// GLFW's own words on what failed last, on one line.
[[noreturn]] void refuse(const std::string& what) {
  const char* text = nullptr;
  glfwGetError(&text);
  std::string why = text == nullptr ? "no reason given" : text;
  std::replace(why.begin(), why.end(), '\n', ' ');
  throw std::system_error(std::make_error_code(std::errc::not_supported), what + ": " + why);
}

}  // namespace

void GlfwWindowDeleter::operator()(GLFWwindow* window) const {
  glfwDestroyWindow(window);
  glfwTerminate();
}

GlfwWindowPtr make_glfw_window(const std::string& title, int width, int height, bool visible) {
  if (glfwInit() == GLFW_FALSE) refuse("no display for a window");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  GlfwWindowPtr window(glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr));
  if (!window) {
    try {
      refuse("no window with OpenGL 3.3");
    } catch (...) {
      glfwTerminate();
      throw;
    }
  }
  watch_for_display_loss();
  glfwMakeContextCurrent(window.get());
  require_opengl_33("the window");
  return window;
}

}  // namespace rakelight
