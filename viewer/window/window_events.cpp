// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/window_events.h"

#include <GLFW/glfw3.h>

#include "viewer/window/key_names.h"

namespace rakelight {
namespace {

WindowEvents& told(GLFWwindow* window) {
  auto& events = *static_cast<WindowEvents*>(glfwGetWindowUserPointer(window));
  events.any();
  return events;
}

void on_button(GLFWwindow* window, int button, int action, int modifiers) {
  const WindowEvents& events = told(window);
  if (action == GLFW_RELEASE) return events.release(events.cursor);
  const MouseButton which = button == GLFW_MOUSE_BUTTON_LEFT    ? MouseButton::left
                            : button == GLFW_MOUSE_BUTTON_RIGHT ? MouseButton::right
                                                                : MouseButton::middle;
  events.press(which, (modifiers & GLFW_MOD_SHIFT) != 0, events.cursor);
}

void on_move(GLFWwindow* window, double x, double y) {
  WindowEvents& events = told(window);
  events.cursor = {x, y};
  events.move(events.cursor);
}

void on_scroll(GLFWwindow* window, double, double notches) {
  const WindowEvents& events = told(window);
  events.scroll(notches, events.cursor);
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int) {
  const WindowEvents& events = told(window);
  if (action == GLFW_PRESS) events.key(key_name(key, scancode));
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  const WindowEvents& events = told(window);
  if (count > 0) events.drop(paths[0]);
}

}  // namespace

void listen(GLFWwindow* window, WindowEvents& events) {
  glfwSetWindowUserPointer(window, &events);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetCursorPosCallback(window, on_move);
  glfwSetScrollCallback(window, on_scroll);
  glfwSetKeyCallback(window, on_key);
  glfwSetDropCallback(window, on_drop);
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { told(w); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { told(w); });
}

}  // namespace rakelight
