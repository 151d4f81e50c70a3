// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A scene in the window, with all that is made of it.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "viewer/gl/framebuffer.h"
#include "viewer/gl/scene_renderer.h"
#include "viewer/view_state.h"
#include "viewer/window/filmstrip.h"

namespace rakelight {

class ShownScene {
 public:
  /// Lives in the window's current OpenGL context.
  explicit ShownScene(Scene scene, const Look& look)
      : scene_(std::move(scene)), surfaces_(scene_), renderer_(surfaces_), last_good_(look) {}

  const Scene& scene() const { return scene_; }
  Box bounds() { return surfaces_.bounds(); }

  /// The same scene and more: the layers that were there stay as they were.
  void extend(Scene scene) { scene_ = std::move(scene); }

  /// Fills the window. A layer that cannot be drawn is refused in the status, and the look before it comes back.
  /// @param size pixels
  void draw(ViewState& state, const cv::Size& size, Detail detail);

  /// Scale bar, divider, marks and, unless a picture is taken, panels and plots. @param size in window units
  void draw_interface(ViewState& state, const cv::Size2f& size);

  /// What a click with the tool in hand does. @param device normalised device coordinates
  void click(ViewState& state, const cv::Point2d& device);

 private:
  void draw_samples(const ViewState& state, const cv::Size& size, Detail detail);

  Scene scene_;
  Surfaces surfaces_;
  SceneRenderer renderer_;
  Filmstrip filmstrip_;
  std::optional<Framebuffer> smooth_;  ///< of the window's size
  Look last_good_;
};

}  // namespace rakelight
