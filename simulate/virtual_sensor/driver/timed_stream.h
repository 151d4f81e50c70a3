// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A stream that runs by itself: exposes, renders and delivers frame after frame on the sensor's clock.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "simulate/virtual_sensor/driver/sensor_stream.h"
#include "simulate/virtual_sensor/driver/virtual_rig_state.h"
#include "simulate/virtual_sensor/frame_schedule.h"

namespace rakelight {

/// Frame n of both streams opens at n periods of the sensor's clock. What is in a frame depends on that clock only: a busy
/// computer makes frames late, never wrong.
class TimedStream : public SensorStream {
 public:
  TimedStream(OniSensorType type, std::vector<OniVideoMode> modes, FieldOfView view,
              std::shared_ptr<VirtualRigState> rig);
  OniStatus start() override;
  void stop() override;

 protected:
  /// Called before the first frame, on the caller's thread.
  virtual void prepare() = 0;
  /// From the first row's opening to the last one's closing, for the frame that opens next.
  virtual double span_us() = 0;
  /// Makes frame n, which opened at start_us, once it is exposed.
  virtual cv::Mat make_frame(int n, double start_us) = 0;

  VirtualRigState& rig() const { return *rig_; }

 private:
  void run();
  bool sleep_until(double sensor_us);
  bool vanishes(int n, int first) const;

  const std::shared_ptr<VirtualRigState> rig_;
  const bool is_color_;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
};

}  // namespace rakelight
