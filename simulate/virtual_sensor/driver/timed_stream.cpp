// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/timed_stream.h"

#include <cmath>

namespace rakelight {

TimedStream::TimedStream(OniSensorType type, std::vector<OniVideoMode> modes, FieldOfView view,
                         std::shared_ptr<VirtualRigState> rig)
    : SensorStream(type, std::move(modes), view), rig_(std::move(rig)), is_color_(type == ONI_SENSOR_COLOR) {}

OniStatus TimedStream::start() {
  stop();
  prepare();
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
  return ONI_STATUS_OK;
}

void TimedStream::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

/// False: the stream shall stop.
bool TimedStream::sleep_until(double sensor_us) {
  std::unique_lock<std::mutex> lock(mutex_);
  const std::chrono::duration<double, std::micro> left(sensor_us - rig_->now_us());
  return !wake_.wait_for(lock, left, [this] { return stopping_; });
}

bool TimedStream::vanishes(int n, int first) const {
  const int at = rig_->setup().unplug_at_frame;
  return is_color_ && at >= 0 && n - first >= at;
}

void TimedStream::run() {
  FrameScheduleOptions options = rig_->setup().frames;
  options.stream = is_color_ ? 0 : 1;
  const FrameSchedule schedule(options);
  const int first = static_cast<int>(std::ceil(rig_->now_us() / options.period_us));
  for (int n = first; rig_->plugged_in(); ++n) {
    const double start = schedule.start_us(n);
    if (!sleep_until(start)) return;
    const double span = span_us();
    if (!sleep_until(start + span)) return;
    if (vanishes(n, first)) return rig_->unplug();
    if (schedule.dropped(n)) continue;
    const cv::Mat image = make_frame(n, start);
    if (!sleep_until(schedule.arrival_us(n, span))) return;
    if (rig_->plugged_in()) deliver(image, n, static_cast<std::uint64_t>(std::llround(start + span)));
  }
}

}  // namespace rakelight
