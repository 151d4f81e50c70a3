// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A window on work in progress: the frames of a scan while lamps switch, then the surface as it is refined.
//
//     show_live("scan", size, [&](LiveFeed& feed) {
//       stack  = capture_stack(..., [&](const SensorFrame& f) { feed.show_color(f.image, "lamp 3"); });
//       result = refine_depth(stack, options, [&](const Progress& p) { feed.show_surface(camera, depth, "iteration 4"); ... });
//     });
#pragma once

#include <functional>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "stack/stack.h"

namespace rakelight {

/// Takes what there is to see from the working thread; the window shows the latest. Any thread may call it.
class LiveFeed {
 public:
  /// @param color CV_8UC3, R G B, as it is to be seen; copied  @param status one line, e.g. the lamp that is lit
  void show_color(const cv::Mat3b& color, const std::string& status);
  /// @param depth raw sensor units, 0 = no reading; copied
  void show_depth(const cv::Mat1w& depth, double depth_unit_m);
  /// From then on the window shows the surface. @param depth metres, NaN where there is none; copied
  void show_surface(const Camera& camera, const cv::Mat1f& depth, const std::string& status);
  /// False once the person has closed the window: the work may go on.
  bool is_watched() const;

  /// What arrived since the last call, for the window.
  struct News {
    cv::Mat3b color, depth;  ///< depth as colours
    std::optional<Camera> camera;
    cv::Mat1f surface;
    std::string status;
    bool any = false;
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

/// Runs `work` in a second thread and the window in this one (the main thread: window systems want that). Closing the
/// window does not stop the work. Returns when the work is done and the window is closed, or when the work throws.
/// @param stay keep the window open when the work is done
/// @throws std::system_error without a display or OpenGL 3.3, before the work begins; what `work` throws
void show_live(const std::string& title, const cv::Size& size, const std::function<void(LiveFeed&)>& work,
               bool stay = true);

}  // namespace rakelight
