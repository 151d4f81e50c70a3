// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/frame_gate.h"

namespace rakelight {

ExposureWindow exposure_window(const FrameTiming& timing, double closes_us) {
  return {closes_us - timing.readout_us - timing.exposure_us, closes_us};
}

FrameGate::Judgement FrameGate::judge(const ExposureWindow& window, const LampLag& lag,
                                      std::int64_t now_us) const {
  const LampEdge* next = nullptr;  // the edge after the one that is looked at
  for (auto edge = edges_.rbegin(); edge != edges_.rend(); next = &*edge, ++edge) {
    if (static_cast<double>(edge->after_us) + lag.latest_us > window.opens_us) continue;
    const std::int64_t certain_until = next != nullptr ? next->before_us : now_us;
    if (window.closes_us <= static_cast<double>(certain_until) + lag.earliest_us)
      return {Verdict::clean, *edge};
    return {next != nullptr ? Verdict::mixed : Verdict::undecided, {}};
  }
  return {};
}

}  // namespace rakelight
