// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random numbers as a pure function of (seed, stream, index), so that no result depends on the order of evaluation.
#pragma once

#include <cmath>
#include <cstdint>

namespace rakelight {

class CounterRandom {
 public:
  CounterRandom(std::uint64_t seed, std::uint64_t stream)
      : key_(mix(mix(seed) ^ (stream * 0xD1342543DE82EF95ULL))) {}

  std::uint64_t bits(std::uint64_t index) const { return mix(key_ + index * 0x9E3779B97F4A7C15ULL); }

  /// Uniform in [0, 1).
  double uniform(std::uint64_t index) const { return static_cast<double>(bits(index) >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(std::uint64_t index, double low, double high) const {
    return low + (high - low) * uniform(index);
  }

  /// Standard normal, by Box and Muller, to single precision: noise needs no more, and it takes half the time.
  double normal(std::uint64_t index) const {
    const auto share = static_cast<float>(1.0 - uniform(2 * index));  // in (0, 1]
    const auto angle = static_cast<float>(6.283185307179586 * uniform(2 * index + 1));
    return static_cast<double>(std::sqrt(-2.0f * std::log(share)) * std::cos(angle));
  }

 private:
  /// The finaliser of splitmix64.
  static std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31);
  }

  std::uint64_t key_;
};

}  // namespace rakelight
