// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where colour and depth frames come from: an OpenNI2 sensor, its virtual twin, a recording, a replayed stack.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stack/errors.h"
#include "stack/stack.h"

namespace rakelight {

/// One image as it arrived. The pixels belong to the frame.
struct SensorFrame {
  cv::Mat image;               ///< CV_8UC3 in R, G, B order, or CV_16UC1 raw depth
  int index = 0;               ///< the sensor's own count: a jump is a drop
  std::int64_t device_us = 0;  ///< sensor clock
  std::int64_t host_us = 0;    ///< host monotonic clock at arrival
};

enum class Stream { color, depth };

/// What a source is and how it encodes: the part of a stack that does not change from frame to frame.
struct SourceDescription {
  Sensor sensor;
  Camera color_camera, depth_camera;
  Eigen::Matrix4d T_color_depth = Eigen::Matrix4d::Identity();
  double depth_unit_m = 0.001;
  double frame_period_us = 33333;
  bool depth_registered_to_color = false;
  bool live = true;  ///< false: a recording, which neither drops nor follows the lamps
};

/// What the sensor was told and what it says it did; empty where it does not tell.
struct ExposureLock {
  std::optional<double> exposure_us, gain;
  bool auto_exposure_off = false, auto_white_balance_off = false;
};

/// Raised by next() when the sensor has gone: unplugged, or silent for longer than the stall limit. Exit code 4.
class SensorLost : public DeviceError {
  using DeviceError::DeviceError;
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual SourceDescription describe() const = 0;
  virtual void start() = 0;
  virtual void stop() = 0;
  /// The next frame in order, or nothing after `timeout`. Frames wait in a queue: none is lost while the caller works.
  /// @throws SensorLost
  virtual std::optional<SensorFrame> next(Stream stream, std::chrono::milliseconds timeout) = 0;
  /// Frames that the queue had to let go because nobody took them, since start().
  virtual int overruns(Stream stream) const = 0;
  /// Switches automatic exposure and white balance off and sets these values; says what the sensor answered.
  virtual ExposureLock lock_exposure(double exposure_us, double gain) = 0;
};

}  // namespace rakelight
