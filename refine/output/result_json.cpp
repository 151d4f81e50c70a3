// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/result_json.h"

#include <Eigen/Core>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/core/version.hpp>

#include "refine/option_fields.h"
#include "refine/output/images.h"
#include "stack/camera_json.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json json_value(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return to_string(value);
  } else {
    return value;
  }
}

/// "depth.sensor_weight" becomes {"depth": {"sensor_weight": ...}}.
Json json_of(const RefineOptions& options) {
  Json json;
  for_each_option(options, [&json](const std::string& name, const auto& value) {
    std::string pointer = "/" + name;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    json[Json::json_pointer(pointer)] = json_value(value);
  });
  return json;
}

Json json_of(const LightEstimate& light) {
  Json rows = Json::array();
  for (int c = 0; c < 3; ++c) {
    const auto row = light.sh_rgb.row(c);
    rows.push_back({row[0], row[1], row[2], row[3]});
  }
  Json json = {{"id", light.id}, {"frame", light.frame_index}, {"sh_rgb", rows}};
  if (light.second_order_rgb) {
    Json& second = json["second_order_rgb"] = Json::array();
    for (const auto& row : light.second_order_rgb->rowwise())
      second.push_back({row[0], row[1], row[2], row[3], row[4]});
  }
  if (light.position_m) {
    json["position_m"] = {light.position_m->x(), light.position_m->y(), light.position_m->z()};
    json["distance_deviation_m"] = light.distance_deviation_m;
    json["direction_deviation_rad"] = light.direction_deviation_rad;
  }
  return json;
}

Json json_of(const IterationReport& iteration) {
  return {{"index", iteration.index},
          {"energy", iteration.energy},
          {"energy_before_depth", iteration.energy_before_depth},
          {"depth_change_mm", iteration.depth_change_mm},
          {"typical_change_mm", iteration.typical_change_mm},
          {"residual_scale", iteration.residual_scale},
          {"backtracks", iteration.backtracks},
          {"sensor_weight", iteration.sensor_weight},
          {"seconds", iteration.seconds}};
}

template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(json_of(item));
  return list;
}

/// @return null without an estimate
Json json_of(const std::optional<ResponseEstimate>& estimate) {
  if (!estimate) return nullptr;
  return {{"gamma", estimate->gamma},
          {"deviation", estimate->deviation},
          {"sure", estimate->sure},
          {"message", estimate->message}};
}

/// @return null where the place is not known
Json json_of(const std::optional<StackPlace>& stack) {
  if (!stack) return nullptr;
  return {{"relative", stack->relative.string()}, {"absolute", stack->absolute.string()}};
}

Json versions() {
  const auto eigen = std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
                     std::to_string(EIGEN_MINOR_VERSION);
  return {{"rakelight", RAKELIGHT_VERSION},
          {"opencv", CV_VERSION},
          {"eigen", eigen},
          {"cholmod", RAKELIGHT_CHOLMOD_VERSION}};
}

}  // namespace

std::string to_string(Termination termination) {
  switch (termination) {
    case Termination::converged:
      return "converged";
    case Termination::max_iterations:
      return "max_iterations";
    case Termination::diverged:
      return "diverged";
  }
  return "unknown";
}

std::string result_json(const RefineResult& result, const std::optional<StackPlace>& stack) {
  const Json json = {{"format", kResultFormat},
                     {"version", kResultVersion},
                     {"termination", to_string(result.termination)},
                     {"message", result.message},
                     {"warnings", result.warnings},
                     {"stack", json_of(stack)},
                     {"camera", camera_json(result.camera)},
                     {"scale", result.scale},
                     {"depth_png_unit_m", depth_unit(result.depth)},
                     {"albedo_png_white", albedo_white(result.albedo)},
                     {"color_response", to_string(result.color_response)},
                     {"response_estimate", json_of(result.response_estimate)},
                     {"quality", result.quality},
                     {"lights", list_of(result.lights)},
                     {"iterations", list_of(result.iterations)},
                     {"options", json_of(result.options)},
                     {"versions", versions()}};
  // Texts come from the stack's manifest: what is no UTF-8 there is replaced, not refused after the work is done.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rakelight
