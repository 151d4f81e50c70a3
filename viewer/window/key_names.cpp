// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/key_names.h"

#include <GLFW/glfw3.h>

#include <cctype>

namespace rakelight {

std::string key_name(int key, int scancode) {
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
  if (key == GLFW_KEY_ESCAPE) return "Escape";
  if (key == GLFW_KEY_TAB) return "Tab";
  const char* printed = glfwGetKeyName(key, scancode);
  if (printed == nullptr) return "";
  std::string name = printed;
  if (name.size() == 1) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

}  // namespace rakelight
