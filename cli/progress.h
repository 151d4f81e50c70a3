// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A progress bar with the time left, on stderr, drawn only on a terminal.
#pragma once

#include <chrono>
#include <string>

#include "refine/refine.h"

namespace rakelight::cli {

class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws the bar anew, at most ten times a second.
  void show(const Progress& progress);

  /// Wipes the bar: the line is free for messages.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool on_terminal_;
  bool visible_ = false;
  Clock::time_point start_, last_drawn_;
};

/// "[#####-----]  50 %  depth step, 12 s left". @param seconds since the start
std::string progress_line(const Progress& progress, double seconds);

}  // namespace rakelight::cli
