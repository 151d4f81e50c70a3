// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/LU>
#include <cmath>

#include "stack/camera_json.h"
#include "stack/color_response.h"
#include "stack/errors.h"
#include "stack/manifest_parts.h"

namespace rakelight {
namespace {

using nlohmann::json;

constexpr double kMaxBalance = 1e6;  // factors of white balance

Camera read_camera(ObjectReader& manifest, const std::string& key, json& unknown) {
  manifest.get(key);
  ObjectReader reader = *manifest.maybe_object(key);
  const Camera camera = read_camera(reader);
  keep_unknown(unknown, key, reader);
  return camera;
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

void check_format(ObjectReader& manifest) {
  if (manifest.text("format") != "rakelight-stack") {
    manifest.refuse("format", "is not \"rakelight-stack\"", "give the manifest of a stack");
  }
  if (manifest.integer("version", 1, INT32_MAX) != 1) {
    manifest.refuse("version", "is newer than this program knows", "update Rakelight");
  }
}

}  // namespace

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
