// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/frame_queue.h"

namespace rakelight {

FrameQueue::FrameQueue(std::string stream, std::size_t capacity, std::chrono::milliseconds stall_limit)
    : stream_(std::move(stream)), capacity_(capacity), stall_limit_(stall_limit) {}

void FrameQueue::push(SensorFrame frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_arrival_ = Clock::now();
    frames_.push_back(std::move(frame));
    if (frames_.size() > capacity_) {
      frames_.pop_front();
      ++overruns_;
    }
  }
  arrived_.notify_all();
}

void FrameQueue::mark_lost() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    lost_ = true;
  }
  arrived_.notify_all();
}

void FrameQueue::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  frames_.clear();
  overruns_ = 0;
  last_arrival_ = Clock::now();
}

bool FrameQueue::wait(std::chrono::milliseconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  return arrived_.wait_for(lock, timeout, [this] { return !frames_.empty() || lost_; }) && !frames_.empty();
}

std::optional<SensorFrame> FrameQueue::pop(std::chrono::milliseconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  arrived_.wait_for(lock, timeout, [this] { return !frames_.empty() || lost_; });
  if (!frames_.empty()) {
    SensorFrame frame = std::move(frames_.front());
    frames_.pop_front();
    return frame;
  }
  if (lost_) throw SensorLost("the sensor has been unplugged; plug it in again and resume the scan");
  if (Clock::now() - last_arrival_ > stall_limit_) {
    throw SensorLost(
        "the sensor's " + stream_ +
        " stream has fallen silent; check its cable and power, plug it in again and resume the scan");
  }
  return std::nullopt;
}

int FrameQueue::overruns() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return overruns_;
}

}  // namespace rakelight
