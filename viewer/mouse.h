// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the mouse does: left turns, right or middle or Shift + left moves, the wheel zooms, a click picks, the divider is
// dragged. Positions are in window units from the upper left corner.
#pragma once

#include <functional>
#include <opencv2/core.hpp>

#include "viewer/view_state.h"

namespace rakelight {

enum class MouseButton { left, middle, right };

class MouseControl {
 public:
  /// @param click called for a left press and release in one place
  explicit MouseControl(std::function<void(const cv::Point2d&)> click) : click_(std::move(click)) {}

  void press(const ViewState& state, MouseButton button, bool shift, const cv::Point2d& at,
             const cv::Size2d& window);
  void move(ViewState& state, const cv::Point2d& to, const cv::Size2d& window);
  void release(const cv::Point2d& at);
  void scroll(ViewState& state, double notches, const cv::Point2d& at, const cv::Size2d& window) const;

  /// Whether a left press there would take the divider.
  static bool on_divider(const ViewState& state, const cv::Point2d& at, const cv::Size2d& window);

 private:
  enum class Drag { none, turn, move, divider };
  Drag drag_ = Drag::none;
  bool may_click_ = false;
  cv::Point2d pressed_, last_;
  std::function<void(const cv::Point2d&)> click_;
};

/// Window units to normalised device coordinates, -1 to 1, y up.
cv::Point2d device_coordinates(const cv::Point2d& at, const cv::Size2d& window);

}  // namespace rakelight
