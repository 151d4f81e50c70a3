// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a scan takes: dark, every lamp, the colour shot, dark.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/rig.h"
#include "stack/stack.h"

namespace rakelight {

/// One state of the lamps and how many images are taken of it.
struct ScanStep {
  std::optional<std::string> light;  ///< id in the stack; none: dark
  std::vector<std::string> lamps;    ///< ids in the rig that are lit
  int images = 1;
  int first_slot = 0;  ///< its images are slots first_slot ... first_slot + images - 1
};

struct ScanPlan {
  std::vector<Light> lights;    ///< of the stack: the rig's lamps, then the colour shot
  std::vector<ScanStep> steps;  ///< dark first and last
  int slots = 0;
};

/// Id of the light of the red, green and blue lamps at once.
inline constexpr const char* kColorShot = "rgb";

/// @param repeats images a lamp  @param rgb_shot adds the colour shot (all red, green and blue lamps)
/// @throws UsageError if the rig has no lamp, or lacks a colour that the shot needs
ScanPlan plan_scan(const Rig& rig, int repeats, bool rgb_shot);

}  // namespace rakelight
