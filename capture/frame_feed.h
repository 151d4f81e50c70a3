// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames of both streams in order, with the clock fitted to them and the watchdog for a sensor that has gone silent.
#pragma once

#include <deque>
#include <functional>

#include "capture/clock_fit.h"
#include "capture/frame_gate.h"
#include "capture/frame_source.h"
#include "capture/host_clock.h"

namespace rakelight {

/// A colour frame and its stamp on the fit's time line.
struct TimedFrame {
  SensorFrame frame;
  std::int64_t time_us = 0;
  int epoch = 0;  ///< ClockFit::epoch() it belongs to
};

class FrameFeed {
 public:
  using TakeFrame = std::function<void(TimedFrame&&)>;
  /// Asked between frames; false: stop.
  using KeepGoing = std::function<bool()>;

  FrameFeed(FrameSource& source, HostClock& clock, FrameTiming timing, KeepGoing keep_going);

  /// Hands colour frames to `take` as they come and keeps depth frames, until the host's clock says `until_us`.
  /// @throws SensorLost also when no colour frame has come for the stall limit; Cancelled.
  void run_until(std::int64_t until_us, const TakeFrame& take);

  /// The next colour frame, whenever it comes. @throws as run_until.
  TimedFrame next_color();

  /// Where a frame lies, and where the first one lies whose rows all open at `from_us` or later (by the frame period).
  ExposureWindow window(std::int64_t time_us) const;
  ExposureWindow next_window(double from_us) const;

  /// The depth frame nearest in device time within a frame period, taken out; an empty image if there is none.
  SensorFrame take_depth_near(std::int64_t device_us);
  /// Whether depth of that device time can still come.
  bool depth_may_come(const SensorFrame& color) const;

  const ClockFit& clock_fit() const { return fit_; }
  HostClock& clock() const { return clock_; }
  const FrameTiming& timing() const { return timing_; }
  void set_exposure(double exposure_us) { timing_.exposure_us = exposure_us; }
  void check_keep_going() const;
  int dropped() const { return dropped_; }

 private:
  /// What the period is counted from.
  struct First {
    std::int64_t time_us;
    int index, epoch;
  };
  std::optional<TimedFrame> poll(std::chrono::milliseconds timeout);
  void drain_depth();
  void learn_period(const TimedFrame& frame);

  FrameSource& source_;
  HostClock& clock_;
  FrameTiming timing_;
  double nominal_period_us_;
  KeepGoing keep_going_;
  ClockFit fit_;
  std::deque<SensorFrame> depth_;
  std::int64_t last_arrival_us_, newest_depth_us_ = 0;
  std::optional<std::int64_t> last_time_us_;
  std::optional<First> first_;
  int last_index_ = -1, dropped_ = 0;
};

}  // namespace rakelight
