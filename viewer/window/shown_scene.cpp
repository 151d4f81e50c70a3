// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/shown_scene.h"

#include <cstdio>

#include "stack/errors.h"
#include "viewer/picking.h"
#include "viewer/window/legend.h"
#include "viewer/window/marks.h"
#include "viewer/window/panel.h"
#include "viewer/window/plots.h"

namespace rakelight {

/// Samples are merged for a picture that stays; while the person turns the surface, speed is worth more.
void ShownScene::draw_samples(const ViewState& state, const cv::Size& size, Detail detail) {
  if (detail == Detail::quick) {
    clear_window();
    return renderer_.draw(state.look, state.camera, size, detail);
  }
  if (!smooth_ || smooth_->size() != size) smooth_.emplace(size);
  smooth_->bind();
  renderer_.draw(state.look, state.camera, size, detail);
  smooth_->show_in_window();
}

void ShownScene::draw(ViewState& state, const cv::Size& size, Detail detail) {
  try {
    draw_samples(state, size, detail);
    last_good_ = state.look;
  } catch (const InputError& error) {
    state.status = error.what();
    state.look = last_good_;
    draw_samples(state, size, detail);
  }
}

void ShownScene::draw_interface(ViewState& state, const cv::Size2f& size) {
  draw_legend(surfaces_.range(state.look.coloring), state.look, size);
  draw_marks(state, size);
  if (state.wants_picture) return;  // the rest is not part of it
  draw_status(state, size);
  if (state.show_panel) draw_panel(state, scene_);
  if (state.show_keys) draw_keys_page(state);
  if (state.show_frames) filmstrip_.draw(state, scene_);
  if (state.show_convergence) draw_convergence(state, scene_);
  draw_profile(state, scene_);
}

void ShownScene::click(ViewState& state, const cv::Point2d& device) {
  if (state.tool == Tool::none) return;
  const bool before = state.look.split && (device.x + 1) / 2 < state.look.divider;
  const Surface& surface = surfaces_.of(before ? state.look.before : state.look.layer);
  const auto picked = pick(surface, ray_through(state.camera, state.aspect, device.x, device.y));
  if (!picked) {
    state.status = "no surface there";
    return;
  }
  add_point(state, picked->point);
  char text[120];
  if (state.points.size() == 2) {
    std::snprintf(text, sizeof text, "distance %.2f mm", measured_mm(state));
  } else {
    std::snprintf(text, sizeof text, "point at (%.2f, %.2f, %.2f) mm", 1000 * picked->point.x(),
                  1000 * picked->point.y(), 1000 * picked->point.z());
  }
  state.status = text;
}

}  // namespace rakelight
