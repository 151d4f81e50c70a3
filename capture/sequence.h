// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shows one lamp after the other and hands out the frames that are entirely lit by one of them.
//
// The sensor runs freely and its frames arrive late, so nothing waits for a frame: the next lamp is switched on as soon as
// the exposure of the frame that is wanted is over by the clock. What a frame really shows is judged when it has arrived.
#pragma once

#include <functional>
#include <vector>

#include "capture/frame_feed.h"
#include "capture/latency.h"
#include "capture/scan_plan.h"
#include "lights/lights.h"

namespace rakelight {

/// A frame that one step lit from its first row's opening to its last row's closing.
struct StepFrame {
  std::size_t step = 0;  ///< index in the plan
  TimedFrame frame;
  ExposureWindow window;
  LampEdge edge;  ///< that switched the step's lamps on
};

struct SequenceTiming {
  double jitter_us = 1000;  ///< a lamp's edge may come this much later than the last time
  double margin_us = 500;   ///< of clocks and of the lag's measurement
};

class Sequence {
 public:
  using TakeFrame = std::function<void(const StepFrame&)>;
  Sequence(FrameFeed& feed, Lights& lights, const ScanPlan& plan, SequenceTiming timing);

  void set_lag(LagEstimate lag) { lag_ = std::move(lag); }
  const LagEstimate& lag() const { return lag_; }

  /// Runs these steps in this order, `images` frames each (0: as many as the plan says); all lamps are off at the end.
  /// `take` gets every clean frame, in order, at the latest before this returns.
  /// @throws SensorLost, Cancelled, std::system_error; the caller switches the lamps off
  /// @return from the opening of the first frame that was aimed at to the closing of the last
  ExposureWindow run(const std::vector<std::size_t>& steps, int images, const TakeFrame& take);

 private:
  void show(std::size_t step);
  void judge_waiting();
  bool still_in_doubt(double last_closes_us) const;
  LampLag lag_bounds() const;

  FrameFeed& feed_;
  Lights& lights_;
  const ScanPlan& plan_;
  SequenceTiming timing_;
  LagEstimate lag_;
  FrameGate gate_;
  std::deque<TimedFrame> waiting_;  ///< not judged yet
  double newest_closes_us_ = 0;
  const TakeFrame* take_ = nullptr;
};

}  // namespace rakelight
