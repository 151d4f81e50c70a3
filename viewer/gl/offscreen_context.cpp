// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/offscreen_context.h"

#include <system_error>

namespace rakelight {

std::unique_ptr<OffscreenContext> make_offscreen_context() {
  std::string without_display;
  try {
    return make_egl_context();
  } catch (const std::system_error& error) { without_display = error.what(); }
  try {
    return make_hidden_window_context();
  } catch (const std::system_error& error) {
    throw std::system_error(std::make_error_code(std::errc::not_supported),
                            "cannot draw a picture: " + without_display + "; " + error.what() +
                                "; install an OpenGL 3.3 driver (Debian: libegl1 libgl1-mesa-dri)");
  }
}

}  // namespace rakelight
