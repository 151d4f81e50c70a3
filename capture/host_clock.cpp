// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/host_clock.h"

#include <chrono>
#include <thread>

namespace rakelight {
namespace {

using Steady = std::chrono::steady_clock;
using Microseconds = std::chrono::microseconds;

class MonotonicClock : public HostClock {
 public:
  std::int64_t now_us() const override {
    return std::chrono::duration_cast<Microseconds>(Steady::now().time_since_epoch()).count();
  }
  void sleep_until(std::int64_t host_us) override {
    std::this_thread::sleep_until(Steady::time_point(Microseconds(host_us)));
  }
};

}  // namespace

HostClock& monotonic_clock() {
  static MonotonicClock clock;
  return clock;
}

}  // namespace rakelight
