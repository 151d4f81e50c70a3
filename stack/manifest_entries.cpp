// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "stack/errors.h"
#include "stack/manifest_parts.h"

namespace rakelight {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxEntries = 4096;  // lights, frames
constexpr std::int64_t kMaxMicroseconds = INT64_MAX;

Light read_light(ObjectReader& reader) {
  Light light;
  light.id = reader.text("id");
  if (light.id.empty()) reader.refuse("id", "is empty", "name the lamp");
  light.color = parse_lamp_color(reader.text("color"), reader.place() + " color");
  if (const auto line = reader.maybe_integer("line", 0, INT32_MAX)) light.line = static_cast<int>(*line);
  if (const auto position = reader.maybe_numbers("position_m")) {
    const auto far = [](double metres) { return std::abs(metres) > kMaxMetres; };
    if (position->size() != 3 || std::any_of(position->begin(), position->end(), far)) {
      reader.refuse("position_m", "is no position", "write three numbers, in metres");
    }
    light.position_m = Eigen::Vector3d(position->data());
  }
  return light;
}

Timestamp read_time(ObjectReader& frame, const std::string& key, json& unknown) {
  auto reader = frame.maybe_object(key);
  if (!reader) return {};
  Timestamp time;
  time.device_us = reader->maybe_integer("device_us", -kMaxMicroseconds, kMaxMicroseconds);
  time.host_us = reader->maybe_integer("host_us", -kMaxMicroseconds, kMaxMicroseconds);
  keep_unknown(unknown, key, *reader);
  return time;
}

std::optional<LitCheck> read_lit_check(ObjectReader& frame, json& unknown) {
  auto reader = frame.maybe_object("lit_check");
  if (!reader) return {};
  LitCheck check;
  reader->get("rows_rgb");
  const auto rows = read_matrix<3>(*reader, "rows_rgb", Eigen::Matrix3d(Eigen::Matrix3d::Zero()));
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) check.rows_rgb[r][c] = rows(Eigen::Index(r), Eigen::Index(c));
  }
  check.matches = reader->boolean("matches");
  keep_unknown(unknown, "lit_check", *reader);
  return check;
}

Frame read_frame(ObjectReader& reader, FrameFiles& files, json& unknown) {
  Frame frame;
  frame.index = static_cast<int>(reader.integer("index", 0, INT32_MAX));
  if (reader.find("light") != nullptr) frame.light = reader.text("light");
  files.color = reader.text("color", "");
  files.depth = reader.text("depth", "");
  if (files.color.empty() && files.depth.empty()) {
    reader.refuse("color", "and depth are both missing", "name at least one image or leave the frame out");
  }
  json rest = json::object();
  frame.color_time = read_time(reader, "color_time", rest);
  frame.depth_time = read_time(reader, "depth_time", rest);
  frame.led_edge_time = read_time(reader, "led_edge_time", rest);
  frame.lit_check = read_lit_check(reader, rest);
  rest.update(reader.unknown());
  if (!rest.empty()) unknown[std::to_string(frame.index)] = std::move(rest);
  return frame;
}

void check_frame(const ObjectReader& reader, const Manifest& manifest, std::set<int>& indices,
                 std::set<std::string>& files) {
  const Frame& frame = manifest.stack.frames.back();
  if (!indices.insert(frame.index).second)
    reader.refuse("index", "is taken by another frame", "number frames once");
  const auto& lights = manifest.stack.lights;
  const auto is_its_light = [&](const Light& light) { return light.id == *frame.light; };
  if (frame.light && std::none_of(lights.begin(), lights.end(), is_its_light)) {
    reader.refuse("light", "'" + *frame.light + "' is not among the lights", "add the lamp to lights");
  }
  for (const std::string& file : {manifest.files.back().color, manifest.files.back().depth}) {
    if (!file.empty() && !files.insert(file).second) {
      reader.refuse("", "names '" + file + "', which another entry names", "name each image once");
    }
  }
}

}  // namespace

LampColor parse_lamp_color(const std::string& text, const std::string& place) {
  for (const LampColor color :
       {LampColor::red, LampColor::green, LampColor::blue, LampColor::white, LampColor::rgb}) {
    if (to_string(color) == text) return color;
  }
  throw InputError(place, "'" + text + "' is no lamp colour", "write red, green, blue, white or rgb");
}

std::vector<Light> read_lights(ObjectReader& manifest, json& unknown) {
  std::vector<Light> lights;
  std::set<std::string> ids;
  json rest = json::object();
  for (ObjectReader& reader : manifest.objects("lights", kMaxEntries)) {
    lights.push_back(read_light(reader));
    const std::string& id = lights.back().id;
    if (!ids.insert(id).second)
      reader.refuse("id", "'" + id + "' is taken by another lamp", "name each lamp once");
    keep_unknown(rest, id, reader);
  }
  if (!rest.empty()) unknown["lights"] = std::move(rest);
  return lights;
}

void read_frames(ObjectReader& reader, Manifest& manifest, json& unknown) {
  std::set<int> indices;
  std::set<std::string> files;
  json rest = json::object();
  for (ObjectReader& frame : reader.objects("frames", kMaxEntries)) {
    manifest.files.emplace_back();
    manifest.stack.frames.push_back(read_frame(frame, manifest.files.back(), rest));
    check_frame(frame, manifest, indices, files);
  }
  if (manifest.files.empty()) reader.refuse("frames", "is empty", "record at least one image");
  if (!rest.empty()) unknown["frames"] = std::move(rest);
}

}  // namespace rakelight
