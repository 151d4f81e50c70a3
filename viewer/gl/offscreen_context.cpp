// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/offscreen_context.h"

#include <cstdlib>
#include <system_error>

namespace rakelight {
namespace {

/// What was wrong, without the code's words that what() adds.
std::string reason(const std::system_error& error) {
  std::string text = error.what();
  const std::string added = ": " + error.code().message();
  const auto at = text.rfind(added);
  if (at != std::string::npos && at + added.size() == text.size()) text.resize(at);
  return text;
}

}  // namespace

std::unique_ptr<OffscreenContext> make_offscreen_context() {
  // Mesa would print its own lines before ours says the same.
  setenv("EGL_LOG_LEVEL", "fatal", 0);
  setenv("LIBGL_DEBUG", "quiet", 0);
  std::string without_display;
  try {
    return make_egl_context();
  } catch (const std::system_error& error) { without_display = reason(error); }
  try {
    return make_hidden_window_context();
  } catch (const std::system_error& error) {
    throw std::system_error(std::make_error_code(std::errc::not_supported),
                            "cannot draw a picture: " + without_display + "; " + reason(error) +
                                "; install an OpenGL 3.3 driver (Debian: libegl1 libgl1-mesa-dri)");
  }
}

}  // namespace rakelight
