// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A window on work in progress: the frames of a scan while lamps switch, then the surface as it is refined.
//
//     show_live("scan", size, [&](LiveFeed& feed) {
//       stack  = capture_stack(..., [&](const SensorFrame& f) { feed.show_color(f.image); });
//       result = refine_depth(stack, options, [&](const Progress& p) { feed.show_surface(camera, depth); ... });
//     });
#pragma once

#include <functional>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "stack/stack.h"
#include "viewer/scene.h"

namespace rakelight {

/// Takes what there is to see from the working thread; the window shows the latest. Any thread may call it.
class LiveFeed {
 public:
  /// @param color CV_8UC3, R G B, as it is to be seen; copied
  void show_color(const cv::Mat3b& color);
  /// @param depth raw sensor units, 0 = no reading; copied
  void show_depth(const cv::Mat1w& depth, double depth_unit_m);
  /// From then on the window shows the surface. @param depth metres, NaN where there is none; copied
  void show_surface(const Camera& camera, const cv::Mat1f& depth);
  /// What the work has come to, instead of the surface so far.
  void show_scene(Scene scene);
  /// One line, e.g. the lamp that is lit.
  void say(const std::string& status);
  /// False once the person has closed the window: whether the work goes on is for it to decide.
  bool is_watched() const;

  /// What arrived since the last call, for the window.
  struct News {
    cv::Mat3b color;
    cv::Mat1w depth;
    double depth_unit_m = 0;
    std::optional<Camera> camera;  ///< of the surface
    cv::Mat1f surface;
    std::optional<Scene> scene;
    std::string status;
  };
  News take();
  void stop_watching();

 private:
  mutable std::mutex mutex_;
  News news_;
  bool watched_ = true;
};

/// Depth as colours for the eye: the 1st to the 99th percentile as near to far, black without a reading.
cv::Mat3b depth_colors(const cv::Mat1w& depth, double depth_unit_m);

/// Runs `work` in a second thread and the window in this one (the main thread: window systems want that). Returns when
/// the work is done and the window is closed, or when the work throws. Whatever ends the window (closed, failed, its
/// display gone), the work hears of it by is_watched() and is waited for.
/// @param keep_open asked while the window still stands after the work is done; empty: until it is closed
/// @throws std::system_error without a display or OpenGL 3.3, before the work begins, or when the display goes away;
///         what `work` throws
void show_live(const std::string& title, const cv::Size& size, const std::function<void(LiveFeed&)>& work,
               const std::function<bool()>& keep_open = {});

}  // namespace rakelight
