// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/camera_json.h"
#include "stack/errors.h"
#include "stack/manifest.h"
#include "stack/strict_json.h"

namespace rakelight {
namespace {

using json = nlohmann::ordered_json;

template <typename Numbers>
json list_of(const Numbers& numbers) {
  json list = json::array();
  for (const double number : numbers) list.push_back(number);
  return list;
}

template <typename Matrix>
json rows_of(const Matrix& matrix) {
  json rows = json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    json row = json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(matrix(r, c));
    rows.push_back(std::move(row));
  }
  return rows;
}

json to_json(const ColorResponse& response) {
  switch (response.kind) {
    case ColorResponse::Kind::linear:
      return "linear";
    case ColorResponse::Kind::srgb:
      return "srgb";
    case ColorResponse::Kind::gamma:
      break;
  }
  return {{"gamma", response.gamma}};
}

template <typename Value>
void put_if(json& object, const std::string& key, const std::optional<Value>& value) {
  if (value) object[key] = *value;
}

json to_json(const Light& light) {
  json result = {{"id", light.id}, {"color", to_string(light.color)}};
  put_if(result, "line", light.line);
  if (light.position_m) {
    const Eigen::Vector3d& p = *light.position_m;
    result["position_m"] = {p.x(), p.y(), p.z()};
  }
  return result;
}

void put_time(json& frame, const std::string& key, const Timestamp& time) {
  json object = json::object();
  put_if(object, "device_us", time.device_us);
  put_if(object, "host_us", time.host_us);
  if (!object.empty()) frame[key] = std::move(object);
}

json to_json(const Frame& frame, const FrameFiles& files) {
  json result = {{"index", frame.index}};
  result["light"] = frame.light ? json(*frame.light) : json(nullptr);
  if (!files.color.empty()) result["color"] = files.color;
  if (!files.depth.empty()) result["depth"] = files.depth;
  put_time(result, "color_time", frame.color_time);
  put_time(result, "depth_time", frame.depth_time);
  put_time(result, "led_edge_time", frame.led_edge_time);
  if (frame.lit_check) {
    json rows = json::array();
    for (const auto& row : frame.lit_check->rows_rgb) rows.push_back(list_of(row));
    result["lit_check"] = {{"rows_rgb", std::move(rows)}, {"matches", frame.lit_check->matches}};
  }
  return result;
}

/// Adds what `extra` has and `object` has not, object by object; what is there stays.
void add_missing(json& object, const json& extra) {
  for (const auto& [key, value] : extra.items()) {
    if (!object.contains(key)) {
      object[key] = value;
    } else if (object[key].is_object() && value.is_object()) {
      add_missing(object[key], value);
    }
  }
}

/// Unknown keys of list entries are kept under the entry's name (a light's id, a frame's index).
void add_missing_to_list(json& list, const std::string& name_key, const json& extra) {
  for (json& entry : list) {
    const json& name = entry[name_key];
    const auto found = extra.find(name.is_string() ? name.get<std::string>() : name.dump());
    if (found != extra.end() && found->is_object()) add_missing(entry, *found);
  }
}

void add_unknown_keys(json& manifest, const std::string& unknown_keys) {
  if (unknown_keys.empty()) return;
  json unknown = json(parse_strict_json(unknown_keys, "the stack's unknown keys"));
  if (!unknown.is_object()) {
    throw InputError("the stack's unknown keys", "are no JSON object", "write keys and values in braces");
  }
  for (const auto& [list, name_key] : {std::pair{"lights", "id"}, std::pair{"frames", "index"}}) {
    if (!unknown.contains(list)) continue;
    add_missing_to_list(manifest[list], name_key, unknown[list]);
    unknown.erase(list);
  }
  add_missing(manifest, unknown);
}

json to_json(const LightStack& stack, const std::vector<FrameFiles>& files) {
  json manifest = {{"format", "rakelight-stack"}, {"version", 1}, {"created", stack.created}};
  const Sensor& sensor = stack.sensor;
  manifest["sensor"] = {{"vendor", sensor.vendor},
                        {"name", sensor.name},
                        {"uri", sensor.uri},
                        {"serial", sensor.serial},
                        {"driver", sensor.driver}};
  manifest["color_camera"] = camera_json(stack.color_camera);
  manifest["depth_camera"] = camera_json(stack.depth_camera);
  manifest["T_color_depth"] = rows_of(stack.T_color_depth);
  manifest["depth_unit_m"] = stack.depth_unit_m;
  manifest["color_response"] = to_json(stack.color_response);
  manifest["color_crosstalk"] = rows_of(stack.color_crosstalk);
  put_if(manifest, "exposure_us", stack.exposure_us);
  put_if(manifest, "gain", stack.gain);
  if (const auto& balance = stack.white_balance) {
    manifest["white_balance"] = {{"red", balance->red}, {"green", balance->green}, {"blue", balance->blue}};
  }
  manifest["lights"] = json::array();
  for (const Light& light : stack.lights) manifest["lights"].push_back(to_json(light));
  manifest["frames"] = json::array();
  for (std::size_t i = 0; i < stack.frames.size(); ++i) {
    manifest["frames"].push_back(to_json(stack.frames[i], files[i]));
  }
  add_unknown_keys(manifest, stack.unknown_keys);
  return manifest;
}

}  // namespace

std::string manifest_text(const LightStack& stack, const std::vector<FrameFiles>& files) {
  // Names from devices may not be UTF-8: such bytes become U+FFFD.
  const std::string text = to_json(stack, files).dump(2, ' ', false, json::error_handler_t::replace) + "\n";
  parse_manifest(text, "the stack to be written");  // nothing is written that could not be read
  return text;
}

}  // namespace rakelight
