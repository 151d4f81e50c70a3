// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/scan_plan.h"

#include <algorithm>

#include "stack/errors.h"

namespace rakelight {
namespace {

std::vector<std::string> color_lamps(const Rig& rig) {
  std::vector<std::string> ids;
  for (const LampColor color : {LampColor::red, LampColor::green, LampColor::blue}) {
    const std::size_t before = ids.size();
    for (const RigLamp& lamp : rig.lamps) {
      if (lamp.color == color) ids.push_back(lamp.id);
    }
    if (ids.size() == before) {
      throw UsageError("the colour shot needs a red, a green and a blue lamp, but rig '" + rig.name +
                       "' has no " + to_string(color) + " one; scan without it or add the lamp");
    }
  }
  return ids;
}

std::optional<int> line_number(const LineAddress& line) {
  if (line.chip.empty()) return std::nullopt;
  return static_cast<int>(line.offset);
}

}  // namespace

ScanPlan plan_scan(const Rig& rig, int repeats, bool rgb_shot) {
  if (rig.lamps.empty())
    throw UsageError("rig '" + rig.name + "' has no lamp; add [[lamp]] tables to its file");
  ScanPlan plan;
  plan.steps.push_back({});
  for (const RigLamp& lamp : rig.lamps) {
    plan.lights.push_back({lamp.id, lamp.color, line_number(lamp.line), lamp.position_m});
    plan.steps.push_back({lamp.id, {lamp.id}, repeats, 0});
  }
  if (rgb_shot) {
    plan.lights.push_back({kColorShot, LampColor::rgb, std::nullopt, std::nullopt});
    plan.steps.push_back({kColorShot, color_lamps(rig), repeats, 0});
  }
  plan.steps.push_back({});
  for (ScanStep& step : plan.steps) {
    step.first_slot = plan.slots;
    plan.slots += step.images;
  }
  return plan;
}

}  // namespace rakelight
