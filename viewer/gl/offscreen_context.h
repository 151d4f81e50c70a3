// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenGL without a window to see.
#pragma once

#include <memory>
#include <string>

namespace rakelight {

/// A current OpenGL context of version 3.3 core or newer; it stays current in its thread while this lives.
class OffscreenContext {
 public:
  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;
  virtual ~OffscreenContext() = default;
  virtual std::string path() const = 0;  ///< how it was made, for people
};

/// By EGL on no display at all; where the driver cannot do that, by a hidden window.
/// @throws std::system_error saying what each way lacked and what to do
std::unique_ptr<OffscreenContext> make_offscreen_context();

/// The two ways. @throws std::system_error
std::unique_ptr<OffscreenContext> make_egl_context();
std::unique_ptr<OffscreenContext> make_hidden_window_context();

}  // namespace rakelight
