// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/rig_file.h"

#include <algorithm>
#include <map>

#include "capture/rig_calibration_file.h"
#include "capture/toml_reader.h"
#include "stack/checked_file.h"
#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr double kSecond_us = 1e6;
constexpr int kMaxLampOnMs = 60'000;
constexpr int kMaxOffset = 1023;
constexpr double kMaxMetres = 100;

void read_mode(TomlReader& sensor, const std::string& key, StreamMode& mode) {
  auto table = sensor.table(key);
  if (!table) return;
  table->read("width", mode.width, 16, 8192);
  table->read("height", mode.height, 16, 8192);
  table->read("fps", mode.fps, 1, 1000);
  table->refuse_unknown();
}

void read_sensor(TomlReader& file, SensorSetup& setup) {
  auto sensor = file.table("sensor");
  if (!sensor) return;
  sensor->read("uri", setup.uri);
  read_mode(*sensor, "color", setup.color);
  read_mode(*sensor, "depth", setup.depth);
  sensor->read("exposure_us", setup.exposure_us, 1, kSecond_us);
  sensor->read("gain", setup.gain, 0, 1e6);
  sensor->read("readout_us", setup.readout_us, 0, kSecond_us);
  sensor->read("lamp_jitter_us", setup.lamp_jitter_us, 0, kSecond_us);
  sensor->refuse_unknown();
  if (setup.exposure_us > kSecond_us / setup.color.fps) {
    sensor->refuse("exposure_us", "is longer than a frame at " + std::to_string(setup.color.fps) + " fps",
                   "expose for less or choose a slower colour mode");
  }
}

LampColor read_lamp_color(TomlReader& lamp) {
  const std::string color = lamp.text("color").value_or("white");
  for (const LampColor known : {LampColor::red, LampColor::green, LampColor::blue, LampColor::white}) {
    if (color == to_string(known)) return known;
  }
  lamp.refuse("color", "is no colour of a lamp",
              "write red, green, blue or white (rgb_shot lights all three)");
}

LineAddress read_line(TomlReader& lamp) {
  LineAddress line;
  lamp.read("line", line.name);
  lamp.read("chip", line.chip);
  lamp.read("active_low", line.active_low);
  const auto offset = lamp.integer("offset", 0, kMaxOffset);
  line.offset = static_cast<unsigned>(offset.value_or(0));
  if (!line.name.empty() && (!line.chip.empty() || offset)) {
    lamp.refuse("line", "and chip with offset are both given", "keep one of the two");
  }
  if (line.chip.empty() && offset) lamp.refuse("offset", "counts lines of no chip", "add chip = \"...\"");
  if (!line.chip.empty() && !offset) lamp.refuse("chip", "is given without a line", "add offset = ...");
  return line;
}

RigLamp read_lamp(TomlReader& table, bool is_virtual) {
  RigLamp lamp;
  table.read("id", lamp.id);
  if (lamp.id.empty()) table.refuse("id", "is missing", "name the lamp, such as id = \"white-north\"");
  lamp.color = read_lamp_color(table);
  lamp.line = read_line(table);
  if (!is_virtual && lamp.line.name.empty() && lamp.line.chip.empty()) {
    table.refuse("", "says on which line the lamp is wired by neither line nor chip and offset",
                 "add line = \"NAME\", or chip = \"LABEL\" and offset = N ('gpioinfo' lists them)");
  }
  if (const auto position = table.numbers("position_m", -kMaxMetres, kMaxMetres)) {
    if (position->size() != 3) table.refuse("position_m", "is no position", "write three numbers, in metres");
    lamp.position_m = Eigen::Vector3d(position->data());
  }
  table.refuse_unknown();
  return lamp;
}

/// What identifies a line; empty for none.
std::string wire_of(const LineAddress& line) {
  if (!line.name.empty()) return "line '" + line.name + "'";
  return line.chip.empty() ? "" : "line " + std::to_string(line.offset) + " of '" + line.chip + "'";
}

std::vector<RigLamp> read_lamps(TomlReader& file, bool is_virtual) {
  std::vector<RigLamp> lamps;
  std::map<std::string, std::string> lamp_on_wire;
  for (TomlReader& table : file.tables("lamps")) {
    const RigLamp lamp = read_lamp(table, is_virtual);
    const auto is_this = [&](const RigLamp& other) { return other.id == lamp.id; };
    if (std::any_of(lamps.begin(), lamps.end(), is_this)) {
      table.refuse("id", "'" + lamp.id + "' is taken by another lamp", "name each lamp once");
    }
    const std::string wire = wire_of(lamp.line);
    const auto [other, added] = lamp_on_wire.emplace(wire, lamp.id);
    if (!wire.empty() && !added) {
      table.refuse("", "is wired to " + wire + ", as lamp '" + other->second + "' is",
                   "give each its own line");
    }
    lamps.push_back(lamp);
  }
  return lamps;
}

/// Refuses what names no lamp. `key` is where the name was read.
void check_lamp_id(const TomlReader& table, const std::string& key, const std::string& id, const Rig& rig) {
  const auto is_it = [&](const RigLamp& lamp) { return lamp.id == id; };
  if (std::none_of(rig.lamps.begin(), rig.lamps.end(), is_it)) {
    table.refuse(key, "names '" + id + "', which is no lamp of this rig", "write the id of one of [[lamps]]");
  }
}

void read_virtual_rig(TomlReader& table, Rig& rig) {
  VirtualRig& faults = rig.virtual_rig.emplace();
  table.read("scene", faults.scene);
  table.read("albedo", faults.albedo);
  faults.seed = static_cast<std::uint64_t>(table.integer("seed", 0, INT64_MAX).value_or(1));
  table.read("lamp_latency_us", faults.lamp_latency_us, 0, kSecond_us);
  table.read("lamp_jitter_us", faults.lamp_jitter_us, 0, kSecond_us);
  table.read("delivery_latency_us", faults.delivery_latency_us, 0, kSecond_us);
  table.read("delivery_jitter_us", faults.delivery_jitter_us, 0, kSecond_us);
  table.read("drop_share", faults.drop_share, 0, 1);
  table.read("unplug_at_frame", faults.unplug_at_frame, -1, INT32_MAX);
  std::string response = to_string(faults.color_response);
  table.read("color_response", response);
  try {
    faults.color_response = parse_color_response(response);
  } catch (const UsageError& error) { table.refuse("color_response", error.what(), "correct it"); }
  table.read("crosstalk", faults.crosstalk, 0, 1);
  table.read("lamps_on_lines", faults.lamps_on_lines);
  table.read("ignores_exposure", faults.ignores_exposure);
  faults.stuck_on = table.texts("stuck_on");
  faults.stuck_off = table.texts("stuck_off");
  faults.dim = table.texts("dim");
  faults.swapped = table.pairs("swapped");
  table.refuse_unknown();
  for (const std::string& id : faults.stuck_on) check_lamp_id(table, "stuck_on", id, rig);
  for (const std::string& id : faults.stuck_off) check_lamp_id(table, "stuck_off", id, rig);
  for (const std::string& id : faults.dim) check_lamp_id(table, "dim", id, rig);
  for (const auto& pair : faults.swapped) {
    for (const std::string& id : pair) check_lamp_id(table, "swapped", id, rig);
  }
}

void require_lines(const TomlReader& file, const Rig& rig) {
  for (const RigLamp& lamp : rig.lamps) {
    if (wire_of(lamp.line).empty())
      file.refuse("lamps", "hang on lines (lamps_on_lines), but '" + lamp.id + "' names none",
                  "add line = \"NAME\", or chip = \"LABEL\" and offset = N");
  }
}

void check_rgb_shot(const TomlReader& file, const Rig& rig) {
  if (!rig.rgb_shot) return;
  for (const LampColor color : {LampColor::red, LampColor::green, LampColor::blue}) {
    const auto has_it = [&](const RigLamp& lamp) { return lamp.color == color; };
    if (std::none_of(rig.lamps.begin(), rig.lamps.end(), has_it)) {
      file.refuse("rgb_shot", "needs a " + to_string(color) + " lamp",
                  "add one under [[lamps]] or write false");
    }
  }
}

}  // namespace

Rig parse_rig(const std::string& text, const std::string& name) {
  const toml::table root = parse_toml(text, name);
  TomlReader file(root, name, "");
  Rig rig;
  rig.name = std::filesystem::path(name).stem().string();
  file.read("name", rig.name);
  file.read("max_on_ms", rig.max_on_ms, 1, kMaxLampOnMs);
  file.read("repeats", rig.repeats, 1, 100);
  file.read("rgb_shot", rig.rgb_shot);
  read_sensor(file, rig.sensor);
  auto virtual_table = file.table("virtual_rig");
  const bool is_virtual = virtual_table || rig.sensor.uri == "virtual";
  rig.lamps = read_lamps(file, is_virtual);
  if (rig.lamps.empty())
    file.refuse("lamps", "are missing", "add a [[lamps]] table a lamp (docs/rig-file.md)");
  if (virtual_table) read_virtual_rig(*virtual_table, rig);
  if (rig.virtual_rig && rig.virtual_rig->lamps_on_lines) require_lines(file, rig);
  if (is_virtual && !rig.virtual_rig) rig.virtual_rig.emplace();
  if (rig.virtual_rig) rig.sensor.uri = "virtual";
  check_rgb_shot(file, rig);
  rig.calibration = read_calibration(file);
  file.refuse_unknown();
  return rig;
}

Rig read_rig(const std::filesystem::path& file) {
  const Bytes bytes = read_file(file, kMaxRigFileBytes);
  return parse_rig(std::string(bytes.begin(), bytes.end()), file.string());
}

}  // namespace rakelight
