// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An X server without a screen, and hands on its mouse and keys.
#pragma once

#include <sys/types.h>

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "tests/support/temporary_folder.h"

namespace rakelight::test {

/// Xvfb; programs started while this lives find it in DISPLAY.
class VirtualScreen {
 public:
  /// Whether Xvfb and xdotool are installed.
  static bool is_available();

  /// @throws std::runtime_error if it does not start
  VirtualScreen(int width, int height);
  ~VirtualScreen();
  VirtualScreen(const VirtualScreen&) = delete;
  VirtualScreen& operator=(const VirtualScreen&) = delete;

  /// Takes the server away from the programs that use it.
  void end() const;

  /// What is on the screen, R G B.
  cv::Mat3b look() const;

  /// The screen once it has not changed for a while; gives up waiting after half a minute.
  cv::Mat3b look_when_still() const;

  /// Looks until the picture is as wanted. @return false after half a minute
  bool wait_for(const std::function<bool(const cv::Mat3b&)>& wanted) const;

  void key(const std::string& name)
      const;  ///< pressed for 0.2 s, as windows that ask for events between frames need
  void move_to(const cv::Point& at) const;
  void click(const cv::Point& at) const;
  void drag(const cv::Point& from, const cv::Point& to, int button = 1) const;

 private:
  TemporaryFolder folder_;
  pid_t server_ = 0;
};

}  // namespace rakelight::test
