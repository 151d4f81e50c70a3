// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/display_loss.h"

#include <X11/Xlib.h>

#include <system_error>

extern "C" Display* glfwGetX11Display(void);  // as in glfw3native.h, which would want Xrandr's header, too

namespace rakelight {
namespace {

bool display_lost = false;

/// Two handlers run in turn: the first may return, the second's return is what keeps the program.
int note_loss(Display*) {
  display_lost = true;
  return 0;
}
void go_on(Display*, void*) {}

}  // namespace

void watch_for_display_loss() {
  display_lost = false;
  XSetIOErrorHandler(note_loss);
  if (Display* const display = glfwGetX11Display()) XSetIOErrorExitHandler(display, go_on, nullptr);
}

void require_display() {
  if (!display_lost) return;
  throw std::system_error(std::make_error_code(std::errc::connection_reset),
                          "drew in a window, but its display went away; look at what was written with "
                          "'rakelight view'");
}

}  // namespace rakelight
