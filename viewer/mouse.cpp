// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/mouse.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr double kClickReach = 4;    ///< a press that moves less is a click, window units
constexpr double kDividerReach = 8;  ///< how near a press takes the divider, window units
constexpr double kZoomANotch = 0.88;

}  // namespace

cv::Point2d device_coordinates(const cv::Point2d& at, const cv::Size2d& window) {
  return {2 * at.x / window.width - 1, 1 - 2 * at.y / window.height};
}

bool MouseControl::on_divider(const ViewState& state, const cv::Point2d& at, const cv::Size2d& window) {
  return state.look.split && std::abs(at.x - state.look.divider * window.width) <= kDividerReach;
}

void MouseControl::press(const ViewState& state, MouseButton button, bool shift, const cv::Point2d& at,
                         const cv::Size2d& window) {
  const bool turns = button == MouseButton::left && !shift;
  drag_ = !turns ? Drag::move : on_divider(state, at, window) ? Drag::divider : Drag::turn;
  may_click_ = drag_ == Drag::turn;
  pressed_ = last_ = at;
}

void MouseControl::move(ViewState& state, const cv::Point2d& to, const cv::Size2d& window) {
  if (drag_ == Drag::none) {
    const cv::Point2d device = device_coordinates(to, window);
    if (state.light_follows_mouse) state.look.light = light_at(device.x, device.y);
    return;
  }
  may_click_ = may_click_ && cv::norm(to - pressed_) < kClickReach;
  if (may_click_) return;
  const cv::Point2d by = (to - last_) / window.height;
  last_ = to;
  if (drag_ == Drag::turn) orbit(state.camera, by.x, by.y);
  if (drag_ == Drag::move) pan(state.camera, by.x, by.y);
  if (drag_ == Drag::divider) state.look.divider = std::clamp(to.x / window.width, 0.0, 1.0);
}

void MouseControl::release(const cv::Point2d& at) {
  if (may_click_) click_(at);
  drag_ = Drag::none;
  may_click_ = false;
}

void MouseControl::scroll(ViewState& state, double notches, const cv::Point2d& at,
                          const cv::Size2d& window) const {
  const cv::Point2d from_middle(at.x - window.width / 2, at.y - window.height / 2);
  zoom(state.camera, std::pow(kZoomANotch, notches), from_middle.x / window.height,
       from_middle.y / window.height);
}

}  // namespace rakelight
