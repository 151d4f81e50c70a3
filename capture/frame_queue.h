// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames between the sensor's thread and the scan's: none is lost while the scan works, and waits always end.
#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>

#include "capture/frame_source.h"

namespace rakelight {

class FrameQueue {
 public:
  using Clock = std::chrono::steady_clock;
  /// More than `capacity` frames: the oldest go. Silence of `stall_limit` since the last frame (or reset()) is a loss.
  FrameQueue(std::string stream, std::size_t capacity, std::chrono::milliseconds stall_limit);

  void push(SensorFrame frame);
  /// The sensor says that it has gone. Frames that had come are still handed out.
  void mark_lost();
  /// Empties the queue and starts the stall clock.
  void reset();
  /// @throws SensorLost
  std::optional<SensorFrame> pop(std::chrono::milliseconds timeout);
  /// Waits for a frame without taking it.
  bool wait(std::chrono::milliseconds timeout);
  int overruns() const;

 private:
  const std::string stream_;
  const std::size_t capacity_;
  const std::chrono::milliseconds stall_limit_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<SensorFrame> frames_;
  Clock::time_point last_arrival_ = Clock::now();
  int overruns_ = 0;
  bool lost_ = false;
};

}  // namespace rakelight
