// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the fake adapter's pins did, in a file that the adapter and the tests map.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace rakelight::test {

struct PinEvent {
  std::int64_t time_us;  ///< CLOCK_MONOTONIC
  std::uint8_t offset;
  std::uint8_t level;
};

struct Pins {
  static constexpr std::size_t kCapacity = 1 << 16;
  std::atomic<std::uint8_t>
      levels;  ///< bit k: pin k is high; nothing but a write through the kernel changes it
  std::atomic<std::uint8_t> held;     ///< bit k: pin k stays as it is, whatever is written to it
  std::atomic<std::uint8_t> outputs;  ///< bit k: pin k is an output
  std::atomic<std::uint32_t> count;   ///< events so far
  PinEvent events[kCapacity];         ///< every write, also one that changes nothing; a ring
};

}  // namespace rakelight::test
