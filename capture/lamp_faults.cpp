// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/lamp_faults.h"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace rakelight {
namespace {

constexpr double kDim = 0.5;            // of the expected level
constexpr double kStuckLevel = 0.35;    // light in the dark frame, of a lamp's level: more than a room's
constexpr double kStuckLikeness = 0.5;  // of the dark's light with the lamp's
constexpr double kAlike = 0.15;         // likenesses that differ by less do not tell two lamps apart
constexpr double kSwapMargin = 0.08;    // by which the other lamp must explain a picture better
constexpr std::size_t kFewestForShares = 3;

class FaultFinder {
 public:
  FaultFinder(const std::vector<RigLamp>& lamps, const LampLight& light) : lamps_(lamps), light_(light) {}

  std::vector<LampFault> find() {
    if (light_.typical() <= 0) return all_dark();
    find_by_level();
    find_swapped_colors();
    find_swapped_places();
    return std::move(faults_);
  }

 private:
  void report(LampFault::Kind kind, std::size_t k, double level, const std::string& text,
              std::string other = {}) {
    faults_.push_back({kind, lamps_[k].id, std::move(other), level, "lamp '" + lamps_[k].id + "' " + text});
  }

  std::vector<LampFault> all_dark() {
    for (std::size_t k = 0; k < lamps_.size(); ++k)
      report(LampFault::Kind::no_light, k, 0,
             "gives no light; check its wiring, its line in the rig file and its supply");
    return std::move(faults_);
  }

  void find_by_level() {
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      const double level = light_.level(k);
      if (level >= kDim) continue;
      if (light_.shines(k)) {
        report(LampFault::Kind::dim, k, level,
               "is dim: " + percent(level) +
                   " of the light that the others lead to expect; clean it, or check its current");
      } else if (lights_the_dark(k)) {
        report(LampFault::Kind::stuck_on, k, 1,
               "is stuck on: it lights the dark frames; check its switch and line");
      } else {
        report(LampFault::Kind::no_light, k, level,
               "gives no light; it is burnt out, unplugged or stuck off");
      }
    }
  }

  static std::string percent(double share) {
    char text[16];
    std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
    return text;
  }

  /// Whether the dark is as bright as a lamp and, where places are known, comes from there rather than from another lamp
  /// that gives no light of its own.
  bool lights_the_dark(std::size_t k) const {
    if (light_.level_in_dark(k) < kStuckLevel) return false;
    const std::optional<double> likeness = light_.likeness_to_dark(k);
    return !likeness || (*likeness > kStuckLikeness && *likeness > greatest_likeness() - kAlike);
  }

  double greatest_likeness() const {
    double greatest = -1;
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      if (!light_.shines(k)) greatest = std::max(greatest, light_.likeness_to_dark(k).value_or(-1));
    }
    return greatest;
  }

  void find_swapped_colors() {
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      for (std::size_t j = k + 1; j < lamps_.size(); ++j) {
        if (lamps_[k].color == lamps_[j].color || lamps_[k].color == light_.seen_color(k)) continue;
        if (light_.seen_color(k) == lamps_[j].color && light_.seen_color(j) == lamps_[k].color) {
          drop_level_faults(k, j);
          report_swap(k, j);
        }
      }
    }
  }

  /// A swapped coloured lamp leaves its own channel dark: that is no second fault.
  void drop_level_faults(std::size_t k, std::size_t j) {
    const auto of_pair = [&](const LampFault& f) { return f.lamp == lamps_[k].id || f.lamp == lamps_[j].id; };
    faults_.erase(std::remove_if(faults_.begin(), faults_.end(), of_pair), faults_.end());
  }

  void report_swap(std::size_t k, std::size_t j) {
    report(LampFault::Kind::swapped, k, 1,
           "is swapped with lamp '" + lamps_[j].id +
               "': each picture shows the other's light; swap their lines in the rig file",
           lamps_[j].id);
  }

  void find_swapped_places() {
    const std::vector<std::size_t> placed = light_.placed_lamps();
    if (placed.size() < kFewestForShares) return;
    const auto table = light_.likeness(placed);
    const auto best = [&](std::size_t i) {
      return std::size_t(std::max_element(table[i].begin(), table[i].end()) - table[i].begin());
    };
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const std::size_t j = best(i);
      const double gain = table[i][j] + table[j][i] - table[i][i] - table[j][j];
      if (j > i && best(j) == i && gain > kSwapMargin) report_swap(placed[i], placed[j]);
    }
  }

  const std::vector<RigLamp>& lamps_;
  const LampLight& light_;
  std::vector<LampFault> faults_;
};

}  // namespace

std::string to_string(LampFault::Kind kind) {
  switch (kind) {
    case LampFault::Kind::no_light:
      return "no-light";
    case LampFault::Kind::stuck_on:
      return "stuck-on";
    case LampFault::Kind::dim:
      return "dim";
    case LampFault::Kind::swapped:
      break;
  }
  return "swapped";
}

std::vector<LampFault> find_lamp_faults(const std::vector<RigLamp>& lamps, const CoarseScene& scene,
                                        const LampPictures& pictures) {
  const LampLight light(lamps, scene, pictures);
  return FaultFinder(lamps, light).find();
}

}  // namespace rakelight
