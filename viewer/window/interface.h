// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Dear ImGui in a window.
#pragma once

struct GLFWwindow;

namespace rakelight {

/// Starts Dear ImGui on a window whose own callbacks are already set: it calls them, too. Letters and spaces follow the
/// screen's scale.
class Interface {
 public:
  explicit Interface(GLFWwindow* window);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  void begin_frame() const;
  void end_frame() const;    ///< draws it
  bool wants_mouse() const;  ///< the mouse is over one of its windows
};

}  // namespace rakelight
