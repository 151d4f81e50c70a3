// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/lamp_timeline.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "simulate/counter_random.h"

namespace rakelight {
namespace {

constexpr std::uint64_t kEdgeJitter = 501;  ///< random stream

void check_lamps(const LampWiring& wiring) {
  const auto check = [&wiring](std::size_t lamp) {
    if (lamp >= wiring.lamps) throw std::invalid_argument("a fault names a lamp that does not exist");
  };
  for (const auto* list : {&wiring.stuck_on, &wiring.stuck_off, &wiring.dim}) {
    std::for_each(list->begin(), list->end(), check);
  }
  for (const auto& [a, b] : wiring.swapped) check(a), check(b);
}

}  // namespace

LampTimeline::LampTimeline(LampWiring wiring)
    : wiring_(std::move(wiring)),
      line_of_lamp_(wiring_.lamps),
      brightness_(wiring_.lamps, 1.0f),
      stuck_on_(wiring_.lamps, 0),
      lines_(wiring_.lamps, false),
      edges_(wiring_.lamps) {
  check_lamps(wiring_);
  std::iota(line_of_lamp_.begin(), line_of_lamp_.end(), std::size_t{0});
  for (const auto& [a, b] : wiring_.swapped) std::swap(line_of_lamp_[a], line_of_lamp_[b]);
  for (const std::size_t lamp : wiring_.dim) brightness_[lamp] = static_cast<float>(kDimBrightness);
  for (const std::size_t lamp : wiring_.stuck_off) brightness_[lamp] = 0;
  for (const std::size_t lamp : wiring_.stuck_on) stuck_on_[lamp] = 1;
}

double LampTimeline::edge_after(double at_us, std::size_t lamp) {
  const double jitter = CounterRandom(wiring_.seed, kEdgeJitter).uniform(drawn_++, 0, wiring_.jitter_us);
  const double edge = at_us + wiring_.latency_us + jitter;
  // A lamp cannot go off before it went on, however the jitter falls.
  return edges_[lamp].empty() ? edge : std::max(edge, edges_[lamp].back());
}

void LampTimeline::write(double at_us, const std::vector<bool>& lines) {
  if (lines.size() != size()) throw std::invalid_argument("as many levels as lamps are needed");
  for (std::size_t lamp = 0; lamp < size(); ++lamp) {
    const std::size_t line = line_of_lamp_[lamp];
    if (lines[line] != lines_[line]) edges_[lamp].push_back(edge_after(at_us, lamp));
  }
  lines_ = lines;
}

bool LampTimeline::lit_at(std::size_t lamp, double at_us) const {
  if (stuck_on_[lamp] != 0) return true;
  const std::vector<double>& edges = edges_[lamp];
  const auto passed = std::upper_bound(edges.begin(), edges.end(), at_us) - edges.begin();
  return brightness_[lamp] > 0 && passed % 2 == 1;
}

double LampTimeline::lit_us(std::size_t lamp, double from_us, double to_us) const {
  const auto brightness = static_cast<double>(brightness_[lamp]);
  if (stuck_on_[lamp] != 0) return brightness * (to_us - from_us);
  const std::vector<double>& edges = edges_[lamp];
  const auto first = std::upper_bound(edges.begin(), edges.end(), from_us);
  bool lit = (first - edges.begin()) % 2 == 1;
  double sum = 0, since = from_us;
  for (auto edge = first; edge != edges.end() && *edge < to_us; ++edge) {
    if (lit) sum += *edge - since;
    since = *edge;
    lit = !lit;
  }
  if (lit) sum += to_us - since;
  return brightness * sum;
}

}  // namespace rakelight
