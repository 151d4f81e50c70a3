// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// When frames of a free-running stream are exposed and when they reach the host: a pure function of the frame's number.
#pragma once

#include <cstdint>

namespace rakelight {

struct FrameScheduleOptions {
  double period_us = 1e6 / 30;
  double delivery_latency_us = 15000;  ///< from the end of readout to the host
  double delivery_jitter_us = 2000;    ///< uniform in [0, jitter), on top
  double drop_share = 0;               ///< share of frames that never reach the host
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;  ///< streams of one sensor draw apart
};

class FrameSchedule {
 public:
  explicit FrameSchedule(const FrameScheduleOptions& options) : options_(options) {}

  /// First row's opening, microseconds after the stream's start.
  double start_us(int frame) const { return frame * options_.period_us; }
  bool dropped(int frame) const;
  /// Arrival at the host of a frame whose last row closes `span_us` after the first opens. Frames do not overtake.
  double arrival_us(int frame, double span_us) const;

 private:
  double undisturbed_arrival_us(int frame, double span_us) const;

  FrameScheduleOptions options_;
};

}  // namespace rakelight
