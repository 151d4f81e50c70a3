// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sensor's clock on the host's: host = a + b * device, fitted while frames arrive.
//
// A frame arrives at its device time plus a delay that is never below some least one and often above it (USB, scheduler).
// The line that all arrivals lie on or above, and that is nearest to them, is the clock; b is only asked for once the
// arrivals span long enough to tell drift from jitter.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace rakelight {

class ClockFit {
 public:
  /// Takes a frame's stamp and the host time of its arrival; frames come in order.
  /// @return the stamp on a time line that goes on over wraps of the 32-bit 60 MHz counter (71.6 s) and over resets
  std::int64_t add(std::int64_t device_us, std::int64_t host_us);

  /// When a frame of this (continuous) device time arrives at the earliest. At least one frame must have been added.
  double host_at(std::int64_t device_us) const;

  bool empty() const { return arrivals_.empty(); }
  double drift() const { return slope_ - 1; }

  /// How often the device clock has been set anew. What was measured against the device clock in an earlier epoch (the
  /// lag of a lamp) is void.
  int epoch() const { return epoch_; }

 private:
  struct Arrival {
    std::int64_t device_us, host_us;
  };
  std::int64_t continuous(std::int64_t device_us, std::int64_t host_us);
  void fit();

  std::deque<Arrival> arrivals_;
  std::optional<Arrival> last_raw_;
  std::int64_t shift_us_ = 0;  ///< continuous = raw + shift
  double slope_ = 1, offset_us_ = 0;
  int epoch_ = 0;
};

}  // namespace rakelight
