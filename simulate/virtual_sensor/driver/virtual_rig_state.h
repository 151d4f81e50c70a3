// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the streams of one virtual sensor share: the scene, the lamps, the clock, whether it is plugged in.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "simulate/virtual_sensor/frame_renderer.h"
#include "simulate/virtual_sensor/rolling_shutter.h"
#include "simulate/virtual_sensor/virtual_scene.h"

namespace rakelight {

/// Thread-safe, but for set_up(): not while a stream runs.
class VirtualRigState {
 public:
  explicit VirtualRigState(std::function<void()> on_unplug);

  /// Builds and renders the scene, switches all lamps off. Telling the same again changes nothing. @throws InputError.
  void set_up(const std::string& text);
  const VirtualSensorSetup& setup() const { return setup_; }

  /// Levels of all lines from now on; false if their number is wrong.
  bool write_lamps(const std::vector<bool>& lines);

  /// Which lamps give light now.
  std::vector<bool> lit_lamps() const;

  /// The lamps' light in a frame that starts at `start_us` of the sensor's clock.
  std::vector<LampRows> light(const RollingShutter& shutter, double start_us) const;

  /// The sensor's clock: microseconds since the first call of any stream.
  double now_us();

  std::shared_ptr<const FrameRenderer> color(cv::Size size);
  std::shared_ptr<const DepthSensor> depth(cv::Size size);

  /// On the grid of the setup's colour images.
  GroundTruth truth();

  bool registered() const { return registered_; }
  void set_registered(bool registered) { registered_ = registered; }

  bool plugged_in() const { return plugged_in_; }
  void unplug();

 private:
  const VirtualScene& scene();

  const std::function<void()> on_unplug_;
  std::string text_;
  VirtualSensorSetup setup_;
  mutable std::mutex lamps_mutex_;
  std::optional<LampTimeline> lamps_;  ///< in host time
  std::mutex scene_mutex_;
  std::unique_ptr<VirtualScene> scene_;
  std::shared_ptr<const FrameRenderer> color_;
  std::shared_ptr<const DepthSensor> depth_;
  cv::Size depth_size_;
  std::mutex clock_mutex_;
  std::optional<double> epoch_us_;  ///< host time of the sensor clock's zero
  std::atomic<bool> registered_{false}, plugged_in_{true};
};

}  // namespace rakelight
