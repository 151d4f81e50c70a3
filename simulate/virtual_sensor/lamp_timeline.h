// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which virtual lamp gave light when. No clock of its own: times are microseconds on any line, given by the caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rakelight {

/// How lines become light, faults included. Lamps and lines are numbered alike.
struct LampWiring {
  std::size_t lamps = 0;
  double latency_us = 2000;                      ///< from the write to light, and from the write to dark
  double jitter_us = 0;                          ///< uniform in [0, jitter), on top, drawn anew an edge
  std::vector<std::size_t> stuck_on, stuck_off;  ///< lamps that no longer follow their line
  std::vector<std::size_t> dim;                  ///< lamps that give kDimBrightness
  std::vector<std::pair<std::size_t, std::size_t>> swapped;  ///< each lamp hangs on the other's line
  std::uint64_t seed = 1;
};

constexpr double kDimBrightness = 0.3;

class LampTimeline {
 public:
  /// Every lamp is off since ever. @throws std::invalid_argument for a lamp that does not exist.
  explicit LampTimeline(LampWiring wiring);

  /// The lines' levels from `at_us` on (lines.size() == lamps). Calls come in order of time.
  void write(double at_us, const std::vector<bool>& lines);

  /// Time for which a lamp was lit within [from, to), weighted by its brightness, microseconds.
  double lit_us(std::size_t lamp, double from_us, double to_us) const;

  /// Whether a lamp gives light at that time.
  bool lit_at(std::size_t lamp, double at_us) const;

  std::size_t size() const { return edges_.size(); }

 private:
  double edge_after(double at_us, std::size_t lamp);

  LampWiring wiring_;
  std::vector<std::size_t> line_of_lamp_;
  std::vector<float> brightness_;
  std::vector<char> stuck_on_;
  std::vector<bool> lines_;
  /// Times at which a lamp changed: even entries on, odd ones off.
  std::vector<std::vector<double>> edges_;
  std::uint64_t drawn_ = 0;
};

}  // namespace rakelight
