// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "stack/camera_json.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/manifest.h"
#include "stack/strict_json.h"

namespace rakelight {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxEntries = 4096;  // lights, frames
constexpr double kMaxBalance = 1e6;        // factors of white balance
constexpr double kMaxMetres = 1e4;         // positions, translations
constexpr std::int64_t kMaxMicroseconds = INT64_MAX;

/// Keeps what a nested reader did not know under the key it was found at.
void keep_unknown(json& unknown, const std::string& key, const ObjectReader& reader) {
  json rest = reader.unknown();
  if (!rest.empty()) unknown[key] = std::move(rest);
}

Camera read_camera(ObjectReader& manifest, const std::string& key, json& unknown) {
  manifest.get(key);
  ObjectReader reader = *manifest.maybe_object(key);
  const Camera camera = read_camera(reader);
  keep_unknown(unknown, key, reader);
  return camera;
}

/// A square matrix as a list of rows; `otherwise` if it is missing.
template <int N>
Eigen::Matrix<double, N, N> read_matrix(ObjectReader& object, const std::string& key,
                                        const Eigen::Matrix<double, N, N>& otherwise) {
  const json* rows = object.find(key);
  if (rows == nullptr) return otherwise;
  const std::string cure = "write " + std::to_string(N) + " rows of " + std::to_string(N) + " finite numbers";
  if (!rows->is_array() || rows->size() != N) object.refuse(key, "is no matrix", cure);
  Eigen::Matrix<double, N, N> matrix;
  for (int r = 0; r < N; ++r) {
    const json& row = (*rows)[static_cast<std::size_t>(r)];
    if (!row.is_array() || row.size() != N) object.refuse(key, "is no matrix", cure);
    for (int c = 0; c < N; ++c) {
      const json& element = row[static_cast<std::size_t>(c)];
      if (!element.is_number() || !(std::abs(element.get<double>()) <= kMaxMetres)) {
        object.refuse(key, "is no matrix of usable numbers", cure);
      }
      matrix(r, c) = element.get<double>();
    }
  }
  return matrix;
}

void check_rigid(const ObjectReader& manifest, const Eigen::Matrix4d& T) {
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  const bool rotation = (R.transpose() * R).isIdentity(1e-4) && R.determinant() > 0;
  if (!rotation || T.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    manifest.refuse("T_color_depth", "is no rigid motion", "write a rotation and a translation in metres");
  }
}

Eigen::Matrix3d read_crosstalk(ObjectReader& manifest) {
  const Eigen::Matrix3d crosstalk =
      read_matrix<3>(manifest, "color_crosstalk", Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  const double norm = crosstalk.norm();
  if (!(std::abs(crosstalk.determinant()) > 1e-6 * norm * norm * norm)) {
    manifest.refuse("color_crosstalk", "cannot be undone (it is singular)",
                    "measure it again or leave it out");
  }
  return crosstalk;
}

ColorResponse read_response(ObjectReader& manifest) {
  const json& value = manifest.get("color_response");
  if (value.is_object()) {
    ObjectReader object(value, manifest.place() + " color_response");
    return {ColorResponse::Kind::gamma, object.number("gamma", 0.01, 100)};
  }
  const bool named = value.is_string() && (value == "linear" || value == "srgb");
  if (!named) manifest.refuse("color_response", "is not known", R"(write "linear", "srgb" or {"gamma": g})");
  return parse_color_response(value.get<std::string>());
}

Sensor read_sensor(ObjectReader& manifest, json& unknown) {
  auto reader = manifest.maybe_object("sensor");
  if (!reader) return {};
  Sensor sensor;
  sensor.vendor = reader->text("vendor", "");
  sensor.name = reader->text("name", "");
  sensor.uri = reader->text("uri", "");
  sensor.serial = reader->text("serial", "");
  sensor.driver = reader->text("driver", "");
  keep_unknown(unknown, "sensor", *reader);
  return sensor;
}

std::optional<WhiteBalance> read_white_balance(ObjectReader& manifest, json& unknown) {
  auto reader = manifest.maybe_object("white_balance");
  if (!reader) return {};
  WhiteBalance balance;
  balance.red = reader->number("red", 0, kMaxBalance);
  balance.green = reader->number("green", 0, kMaxBalance);
  balance.blue = reader->number("blue", 0, kMaxBalance);
  keep_unknown(unknown, "white_balance", *reader);
  return balance;
}

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

void check_format(ObjectReader& manifest) {
  if (manifest.text("format") != "rakelight-stack") {
    manifest.refuse("format", "is not \"rakelight-stack\"", "give the manifest of a stack");
  }
  if (manifest.integer("version", 1, INT32_MAX) != 1) {
    manifest.refuse("version", "is newer than this program knows", "update Rakelight");
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

Manifest parse_manifest(const std::string& text, const std::string& file) {
  const json document = parse_strict_json(text, file);
  ObjectReader reader(document, file);
  json unknown = json::object();
  Manifest manifest;
  LightStack& stack = manifest.stack;
  check_format(reader);
  stack.created = reader.text("created", "");
  stack.sensor = read_sensor(reader, unknown);
  stack.color_camera = read_camera(reader, "color_camera", unknown);
  stack.depth_camera = read_camera(reader, "depth_camera", unknown);
  stack.T_color_depth = read_matrix<4>(reader, "T_color_depth", stack.T_color_depth);
  check_rigid(reader, stack.T_color_depth);
  stack.depth_unit_m = reader.number("depth_unit_m", 1e-9, 1);
  stack.color_response = read_response(reader);
  stack.color_crosstalk = read_crosstalk(reader);
  stack.exposure_us = reader.maybe_number("exposure_us", 0, 1e12);
  stack.gain = reader.maybe_number("gain", 0, 1e9);
  stack.white_balance = read_white_balance(reader, unknown);
  stack.lights = read_lights(reader, unknown);
  read_frames(reader, manifest, unknown);
  unknown.update(reader.unknown());
  if (!unknown.empty()) stack.unknown_keys = unknown.dump();
  return manifest;
}

}  // namespace rakelight
