// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/sequence.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr int kNoStep = -1;
constexpr std::int64_t kDeliveryPatience_us = 300'000;  // after the last exposure, for frames that come late

}  // namespace

Sequence::Sequence(FrameFeed& feed, Lights& lights, const ScanPlan& plan, SequenceTiming timing)
    : feed_(feed), lights_(lights), plan_(plan), timing_(timing) {}

LampLag Sequence::lag_bounds() const {
  return lag_.bounds(feed_.clock_fit(), timing_.jitter_us, timing_.margin_us);
}

void Sequence::show(std::size_t step) {
  LampEdge edge;
  edge.before_us = feed_.clock().now_us();
  lights_.show(plan_.steps[step].lamps);
  edge.after_us = feed_.clock().now_us();
  edge.state = static_cast<int>(step);
  gate_.add(edge);
}

void Sequence::judge_waiting() {
  const LampLag lag = lag_bounds();
  while (!waiting_.empty()) {
    TimedFrame& frame = waiting_.front();
    if (feed_.depth_may_come(frame.frame)) return;
    const ExposureWindow window = feed_.window(frame.time_us);
    const FrameGate::Judgement judgement = gate_.judge(window, lag, feed_.clock().now_us());
    if (judgement.verdict == FrameGate::Verdict::undecided) return;
    // After a reset of the device's clock the lag no longer holds: such frames prove nothing.
    const bool timed = frame.epoch == lag_.epoch;
    if (timed && judgement.verdict == FrameGate::Verdict::clean && judgement.edge.state != kNoStep) {
      (*take_)({static_cast<std::size_t>(judgement.edge.state), std::move(frame), window, judgement.edge});
    }
    waiting_.pop_front();
  }
}

bool Sequence::still_in_doubt(double last_closes_us) const {
  if (!waiting_.empty()) return true;
  return newest_closes_us_ < last_closes_us - feed_.timing().period_us / 2;
}

ExposureWindow Sequence::run(const std::vector<std::size_t>& steps, int images, const TakeFrame& take) {
  take_ = &take;
  const auto queue = [this](TimedFrame&& frame) {
    newest_closes_us_ = feed_.window(frame.time_us).closes_us;
    waiting_.push_back(std::move(frame));
    judge_waiting();
  };
  double closes_us = 0;
  std::optional<double> opens_us;
  for (const std::size_t step : steps) {
    show(step);
    const int wanted = images > 0 ? images : plan_.steps[step].images;
    const LampLag lag = lag_bounds();
    // Half a margin, so that a frame at the limit, whose time is known to within rounding only, still passes the gate.
    const double lit_us =
        static_cast<double>(gate_.newest().after_us) + lag.latest_us + timing_.margin_us / 2;
    const ExposureWindow window = feed_.next_window(lit_us);
    if (!opens_us) opens_us = window.opens_us;
    closes_us = window.closes_us + (wanted - 1) * feed_.timing().period_us;
    feed_.run_until(std::llround(closes_us - lag.earliest_us + timing_.margin_us / 2), queue);
  }
  LampEdge off;
  off.before_us = feed_.clock().now_us();
  lights_.all_off();
  off.after_us = feed_.clock().now_us();
  off.state = kNoStep;
  gate_.add(off);
  const std::int64_t give_up_us = std::llround(closes_us) + kDeliveryPatience_us;
  while (still_in_doubt(closes_us) && feed_.clock().now_us() < give_up_us) {
    feed_.run_until(feed_.clock().now_us() + std::llround(feed_.timing().period_us / 4), queue);
    judge_waiting();
  }
  return {opens_us.value_or(closes_us), closes_us};
}

}  // namespace rakelight
