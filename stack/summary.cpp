// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/summary.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "stack/check.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr double kMuchSaturated = 0.05, kLittleDepth = 0.5;

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

void add_color(const LightStack& stack, const Frame& frame, StackSummary& summary) {
  ++summary.color_images;
  summary.color_bits = frame.color.depth() == CV_16U ? 16 : 8;
  if (!frame.light) {
    ++summary.dark_images;
    return;
  }
  const double saturated = saturated_share(stack, frame);
  summary.saturated_mean += saturated;
  if (saturated > summary.saturated_worst) {
    summary.saturated_worst = saturated;
    summary.worst_light = *frame.light;
  }
  if (is_black(stack, frame))
    summary.warnings.push_back("Lamp " + *frame.light + " left no light on the object.");
}

void add_depth(const LightStack& stack, const Frame& frame, StackSummary& summary) {
  ++summary.depth_images;
  double lowest = 0, highest = 0;
  cv::minMaxLoc(frame.depth, &lowest, &highest, nullptr, nullptr, frame.depth > 0);
  if (highest == 0) return;  // no reading at all
  const double nearest = lowest * stack.depth_unit_m;
  summary.nearest_m = summary.nearest_m == 0 ? nearest : std::min(summary.nearest_m, nearest);
  summary.farthest_m = std::max(summary.farthest_m, highest * stack.depth_unit_m);
}

/// Depth pixels the object would fill at most: the mask's area, from its camera's grid to the depth camera's.
double object_depth_pixels(const LightStack& stack) {
  if (stack.mask.empty()) return stack.depth_camera.size().area();
  const double area = cv::countNonZero(stack.mask);
  if (stack.mask.size() != stack.color_camera.size()) return area;
  return area * (stack.depth_camera.fx / stack.color_camera.fx) *
         (stack.depth_camera.fy / stack.color_camera.fy);
}

void warn(const LightStack& stack, StackSummary& summary) {
  auto& warnings = summary.warnings;
  if (stack.mask.empty())
    warnings.push_back("There is no mask: every pixel with depth counts as the object.");
  if (summary.saturated_worst > kMuchSaturated) {
    warnings.push_back("Under lamp " + summary.worst_light + " " + percent(summary.saturated_worst) +
                       " of the object is saturated: expose less.");
  }
  if (summary.depth_images > 0 && !stack.mask.empty() && summary.depth_coverage < kLittleDepth) {
    warnings.push_back("Depth covers only " + percent(summary.depth_coverage) +
                       " of the object: check the sensor's range.");
  }
  if (summary.lit_matching < summary.lit_checked) {
    warnings.push_back(std::to_string(summary.lit_checked - summary.lit_matching) +
                       " frames do not show the lamp they name: check the lamps' wiring.");
  }
  try {
    check_stack(stack);
  } catch (const InputError& error) {
    warnings.push_back(std::string("It cannot be refined: ") + error.what() + ".");
  }
}

}  // namespace

StackSummary summarise(const LightStack& stack) {
  StackSummary summary;
  for (const Frame& frame : stack.frames) {
    if (!frame.color.empty()) add_color(stack, frame, summary);
    if (!frame.depth.empty()) add_depth(stack, frame, summary);
    if (frame.lit_check) {
      ++summary.lit_checked;
      summary.lit_matching += frame.lit_check->matches ? 1 : 0;
    }
  }
  summary.saturated_mean /= std::max(1, summary.color_images - summary.dark_images);
  summary.object_pixels = stack.mask.empty() ? 0 : cv::countNonZero(stack.mask);
  if (summary.depth_images > 0) {
    summary.depth_coverage =
        std::min(1.0, masked_depth_count(stack) / std::max(1.0, object_depth_pixels(stack)));
  }
  warn(stack, summary);
  return summary;
}

}  // namespace rakelight
