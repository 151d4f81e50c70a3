// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/frame_schedule.h"

#include <algorithm>

#include "simulate/counter_random.h"

namespace rakelight {
namespace {

enum Stream : std::uint64_t { kDelivery = 511, kDrops = 521 };  // one more a stream of the sensor

}  // namespace

bool FrameSchedule::dropped(int frame) const {
  const CounterRandom random(options_.seed, kDrops + options_.stream);
  return random.uniform(static_cast<std::uint64_t>(frame)) < options_.drop_share;
}

double FrameSchedule::undisturbed_arrival_us(int frame, double span_us) const {
  const CounterRandom random(options_.seed, kDelivery + options_.stream);
  return start_us(frame) + span_us + options_.delivery_latency_us +
         random.uniform(static_cast<std::uint64_t>(frame), 0, options_.delivery_jitter_us);
}

double FrameSchedule::arrival_us(int frame, double span_us) const {
  // Only frames that start less than the jitter earlier can hold this one up.
  const int reach = static_cast<int>(options_.delivery_jitter_us / options_.period_us);
  double arrival = undisturbed_arrival_us(frame, span_us);
  for (int earlier = std::max(0, frame - reach); earlier < frame; ++earlier) {
    arrival = std::max(arrival, undisturbed_arrival_us(earlier, span_us));
  }
  return arrival;
}

}  // namespace rakelight
