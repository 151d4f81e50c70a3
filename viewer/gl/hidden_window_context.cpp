// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/gl/gl_object.h"
#include "viewer/gl/glfw_window.h"
#include "viewer/gl/offscreen_context.h"

namespace rakelight {
namespace {

class HiddenWindowContext : public OffscreenContext {
 public:
  std::string path() const override { return "a hidden window on " + std::string(renderer_name()); }

 private:
  GlfwWindowPtr window_ = make_glfw_window("rakelight", 64, 64, false);
};

}  // namespace

std::unique_ptr<OffscreenContext> make_hidden_window_context() {
  return std::make_unique<HiddenWindowContext>();
}

}  // namespace rakelight
