// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The host's monotonic clock as a seam, so that a scan runs against a simulated one in the tests.
#pragma once

#include <cstdint>

namespace rakelight {

class HostClock {
 public:
  virtual ~HostClock() = default;
  /// Microseconds of the clock that SensorFrame::host_us is read from.
  virtual std::int64_t now_us() const = 0;
  virtual void sleep_until(std::int64_t host_us) = 0;
};

/// CLOCK_MONOTONIC.
HostClock& monotonic_clock();

}  // namespace rakelight
