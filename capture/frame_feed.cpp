// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/frame_feed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr std::int64_t kStallLimit_us = 1'500'000;  // the program must say so within 2 s
constexpr std::int64_t kSlice_us = 20'000;          // how long a wait may be deaf to an interrupt
constexpr std::size_t kDepthKept = 90;
constexpr int kFewestPeriods = 3;
constexpr double kPeriodTolerance = 0.1;  // beyond it the frames' numbers are not to be trusted

}  // namespace

FrameFeed::FrameFeed(FrameSource& source, HostClock& clock, FrameTiming timing, KeepGoing keep_going)
    : source_(source),
      clock_(clock),
      timing_(timing),
      nominal_period_us_(timing.period_us),
      keep_going_(std::move(keep_going)),
      last_arrival_us_(clock.now_us()) {}

void FrameFeed::check_keep_going() const {
  if (keep_going_ && !keep_going_()) throw Cancelled("the lamps are off");
}

void FrameFeed::drain_depth() {
  using std::chrono::milliseconds;
  while (std::optional<SensorFrame> frame = source_.next(Stream::depth, milliseconds(0))) {
    newest_depth_us_ = frame->device_us;
    depth_.push_back(std::move(*frame));
    if (depth_.size() > kDepthKept) depth_.pop_front();
  }
}

/// Devices say 30 fps and mean 29.97: the stamps tell, the more exactly the longer the stream runs.
void FrameFeed::learn_period(const TimedFrame& frame) {
  if (last_time_us_) dropped_ += std::max(0, frame.frame.index - last_index_ - 1);
  if (!first_ || first_->epoch != frame.epoch || frame.frame.index < first_->index) {
    first_ = First{frame.time_us, frame.frame.index, frame.epoch};
    return;
  }
  const int periods = frame.frame.index - first_->index;
  if (periods < kFewestPeriods) return;
  const double period_us = static_cast<double>(frame.time_us - first_->time_us) / periods;
  if (std::abs(period_us / nominal_period_us_ - 1) < kPeriodTolerance) timing_.period_us = period_us;
}

std::optional<TimedFrame> FrameFeed::poll(std::chrono::milliseconds timeout) {
  check_keep_going();
  std::optional<SensorFrame> frame = source_.next(Stream::color, timeout);
  drain_depth();
  if (!frame) {
    if (clock_.now_us() - last_arrival_us_ > kStallLimit_us) {
      throw SensorLost(
          "waited for a frame of the sensor, but none has come for 1.5 s; is it still plugged in?");
    }
    return std::nullopt;
  }
  last_arrival_us_ = clock_.now_us();
  const bool repeated = frame->index == last_index_ && last_time_us_;
  if (repeated) return std::nullopt;
  TimedFrame timed;
  timed.time_us = fit_.add(frame->device_us, frame->host_us);
  timed.epoch = fit_.epoch();
  timed.frame = std::move(*frame);
  learn_period(timed);
  last_time_us_ = timed.time_us;
  last_index_ = timed.frame.index;
  return timed;
}

void FrameFeed::run_until(std::int64_t until_us, const TakeFrame& take) {
  for (;;) {
    const std::int64_t left = until_us - clock_.now_us();
    if (left <= 0) return;
    const auto wait = std::chrono::milliseconds(std::min(left, kSlice_us) / 1000);
    if (std::optional<TimedFrame> frame = poll(wait)) {
      take(std::move(*frame));
    } else if (left < 1000) {
      clock_.sleep_until(until_us);
    }
  }
}

TimedFrame FrameFeed::next_color() {
  for (;;) {
    if (std::optional<TimedFrame> frame = poll(std::chrono::milliseconds(kSlice_us / 1000)))
      return std::move(*frame);
  }
}

ExposureWindow FrameFeed::window(std::int64_t time_us) const {
  return exposure_window(timing_, fit_.host_at(time_us));
}

ExposureWindow FrameFeed::next_window(double from_us) const {
  ExposureWindow window = this->window(*last_time_us_);
  const double ahead = std::ceil((from_us - window.opens_us) / timing_.period_us) * timing_.period_us;
  return {window.opens_us + ahead, window.closes_us + ahead};
}

bool FrameFeed::depth_may_come(const SensorFrame& color) const {
  return newest_depth_us_ < color.device_us &&
         clock_.now_us() < color.host_us + std::lround(2 * timing_.period_us);
}

SensorFrame FrameFeed::take_depth_near(std::int64_t device_us) {
  const auto distance = [device_us](const SensorFrame& f) { return std::llabs(f.device_us - device_us); };
  const auto nearest = std::min_element(
      depth_.begin(), depth_.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest == depth_.end() || static_cast<double>(distance(*nearest)) > timing_.period_us) return {};
  SensorFrame frame = std::move(*nearest);
  depth_.erase(nearest);
  return frame;
}

}  // namespace rakelight
