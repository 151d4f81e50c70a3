// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rakelight::cli {
namespace {

constexpr int kBarWidth = 30;
constexpr double kFirstGuess = 0.03;  ///< below this share done, a time left would be noise

std::string time_left(double fraction, double seconds) {
  if (fraction < kFirstGuess) return "";
  const auto left = static_cast<long>(std::ceil(seconds * (1 - fraction) / fraction));
  if (left < 100) return ", " + std::to_string(left) + " s left";
  return ", " + std::to_string((left + 59) / 60) + " min left";
}

}  // namespace

std::string progress_line(const Progress& progress, double seconds) {
  const double fraction = std::clamp(progress.fraction_done, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::lround(fraction * kBarWidth));
  const std::string percent = std::to_string(std::lround(fraction * 100));
  return "[" + std::string(filled, '#') + std::string(kBarWidth - filled, '-') + "] " +
         std::string(3 - percent.size(), ' ') + percent + " %  " + progress.stage +
         time_left(fraction, seconds);
}

ProgressBar::ProgressBar() : on_terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(const Progress& progress) {
  const auto now = Clock::now();
  if (!on_terminal_ || (visible_ && now - last_drawn_ < std::chrono::milliseconds(100))) return;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%s", progress_line(progress, seconds).c_str());
  last_drawn_ = now;
  visible_ = true;
}

void ProgressBar::clear() {
  if (visible_) std::fputs("\r\033[K", stderr);
  visible_ = false;
}

}  // namespace rakelight::cli
