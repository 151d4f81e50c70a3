// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/stack_header.h"

#include <chrono>
#include <ctime>

namespace rakelight {
namespace {

/// RFC 3339, UTC.
std::string now_text() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

LightStack stack_header(const SourceDescription& source, const Rig& rig, const ScanPlan& plan) {
  LightStack stack;
  stack.created = now_text();
  stack.sensor = source.sensor;
  stack.color_camera = rig.calibration.color_camera.value_or(source.color_camera);
  stack.depth_camera = rig.calibration.depth_camera.value_or(source.depth_camera);
  stack.T_color_depth = source.T_color_depth;
  if (source.depth_registered_to_color) {
    stack.T_color_depth = Eigen::Matrix4d::Identity();
  } else if (rig.calibration.T_color_depth) {
    stack.T_color_depth = *rig.calibration.T_color_depth;
  }
  stack.depth_unit_m = source.depth_unit_m;
  stack.color_response = rig.calibration.color_response.value_or(stack.color_response);
  stack.color_crosstalk = rig.calibration.color_crosstalk.value_or(stack.color_crosstalk);
  stack.lights = plan.lights;
  return stack;
}

}  // namespace rakelight
