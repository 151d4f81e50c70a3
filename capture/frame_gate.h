// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which frames are entirely lit by one lamp and by nothing else: the gate by time.
//
// All times are on one line, the host's clock at the earliest arrival of a frame (capture/clock_fit.h): a frame whose last
// row closes at device time d closes there at ClockFit::host_at(d). A lamp that is written at time t shows up there
// at t + lag, and one lag holds the lamp's own latency, the frame's transport and whatever the device's stamp means:
// they need not be known apart.
#pragma once

#include <cstdint>
#include <vector>

namespace rakelight {

/// The rolling shutter. Row r of 0 (first) to 1 (last) is open for `exposure_us`, and closes at
/// closes_us - (1 - r) * readout_us.
struct FrameTiming {
  double exposure_us = 8000;
  double readout_us = 30000;
  double period_us = 33333;
};

/// From the first row's opening to the last row's closing.
struct ExposureWindow {
  double opens_us = 0, closes_us = 0;
};
ExposureWindow exposure_window(const FrameTiming& timing, double closes_us);

/// From a write to the light, with the doubt in it.
struct LampLag {
  double latest_us = 0;    ///< after the writing call has returned: by then the new state is certain
  double earliest_us = 0;  ///< after the writing call has begun: until then the old state is certain
};

/// When a state was written: the edge lies between the two (and `lag` later).
struct LampEdge {
  std::int64_t before_us = 0, after_us = 0;
  int state = 0;
};

class FrameGate {
 public:
  enum class Verdict { clean, mixed, undecided };
  struct Judgement {
    Verdict verdict = Verdict::mixed;
    LampEdge edge;  ///< clean: which switched the frame's state on
  };

  void add(const LampEdge& edge) { edges_.push_back(edge); }
  /// `undecided`: the next edge has not been written by `now_us` but could still fall into the window.
  Judgement judge(const ExposureWindow& window, const LampLag& lag, std::int64_t now_us) const;
  const LampEdge& newest() const { return edges_.back(); }

 private:
  std::vector<LampEdge> edges_;  ///< in order of time
};

}  // namespace rakelight
