// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdio>
#include <utility>

#include "capture/rig_calibration_file.h"
#include "capture/rig_file.h"
#include "capture/toml_edit.h"
#include "stack/errors.h"
#include "stack/replace_file.h"

namespace rakelight {
namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  const std::string digits = text;
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

template <class Values>
std::string list_text(const Values& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return "[" + text + "]";
}

template <class Matrix>
std::string matrix_text(const Matrix& matrix) {
  std::string text;
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    text += (r == 0 ? "\n  " : ",\n  ") + list_text(Eigen::VectorXd(matrix.row(r)));
  }
  return "[" + text + ",\n]";
}

std::string response_text(const ColorResponse& response) {
  if (response.kind == ColorResponse::Kind::linear) return "\"linear\"";
  if (response.kind == ColorResponse::Kind::srgb) return "\"srgb\"";
  return "{ gamma = " + number_text(response.gamma) + " }";
}

/// A rig file's text in which values are set one after another.
class Edit {
 public:
  Edit(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

  /// Sets the value unless the file says the same already.
  void set(const std::string& table, const std::string& key, const std::string& value,
           const std::string& old) {
    if (value != old) text_ = with_toml_value(text_, table, key, value, file_);
  }
  void set(const std::string& table, const std::string& key, double value, double old) {
    set(table, key, number_text(value), number_text(old));
  }
  /// The same for what may be missing; what the file has is never taken out.
  template <class T, class Write>
  void set(const std::string& table, const std::string& key, const std::optional<T>& value,
           const std::optional<T>& old, const Write& write) {
    if (value) set(table, key, write(*value), old ? write(*old) : "");
  }
  void set_camera(const std::string& key, const std::optional<Camera>& camera,
                  const std::optional<Camera>& old) {
    if (!camera) return;
    const std::string table = "calibration." + key;
    const Camera before = old.value_or(Camera{});
    set(table, "width", std::to_string(camera->width), std::to_string(before.width));
    set(table, "height", std::to_string(camera->height), std::to_string(before.height));
    for (const auto& [name, member] : {std::pair{"fx", &Camera::fx}, std::pair{"fy", &Camera::fy},
                                       std::pair{"cx", &Camera::cx}, std::pair{"cy", &Camera::cy}}) {
      if (old)
        set(table, name, (*camera).*member, before.*member);
      else
        set(table, name, number_text((*camera).*member), "");
    }
    set(table, "distortion", list_text(camera->distortion), list_text(before.distortion));
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_, file_;
};

std::string position_text(const Eigen::Vector3d& position) { return list_text(position); }

void set_positions(const Rig& rig, const Rig& old, Edit& edit) {
  for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
    edit.set("lamps[" + std::to_string(k) + "]", "position_m", rig.lamps[k].position_m,
             old.lamps[k].position_m, position_text);
  }
}

void set_timing(const SensorSetup& sensor, const SensorSetup& old, Edit& edit) {
  edit.set("sensor", "readout_us", sensor.readout_us, old.readout_us);
  edit.set("sensor", "lamp_jitter_us", sensor.lamp_jitter_us, old.lamp_jitter_us);
}

void set_optics(const RigCalibration& now, const RigCalibration& old, Edit& edit) {
  edit.set("calibration", "color_response", now.color_response, old.color_response, response_text);
  edit.set("calibration", "color_crosstalk", now.color_crosstalk, old.color_crosstalk,
           matrix_text<Eigen::Matrix3d>);
  edit.set("calibration", "T_color_depth", now.T_color_depth, old.T_color_depth,
           matrix_text<Eigen::Matrix4d>);
  edit.set_camera("color_camera", now.color_camera, old.color_camera);
  edit.set_camera("depth_camera", now.depth_camera, old.depth_camera);
}

/// Everything calibration writes, as text with the precision it is written in.
std::string fingerprint(const Rig& rig) {
  Edit all("", "");
  Rig nothing;
  nothing.lamps = rig.lamps;
  for (RigLamp& lamp : nothing.lamps) lamp.position_m.reset();
  set_optics(rig.calibration, nothing.calibration, all);
  std::string text = all.text();
  for (const RigLamp& lamp : rig.lamps)
    text += lamp.id + (lamp.position_m ? position_text(*lamp.position_m) : "");
  const SensorSetup& s = rig.sensor;
  return text + list_text(std::vector<double>{s.readout_us, s.lamp_jitter_us});
}

bool same_lamps(const Rig& a, const Rig& b) {
  return std::equal(a.lamps.begin(), a.lamps.end(), b.lamps.begin(), b.lamps.end(),
                    [](const RigLamp& one, const RigLamp& other) { return one.id == other.id; });
}

/// The edited text, if it is a rig file that gives these results back.
std::optional<std::string> edited(const std::string& text, const Rig& rig, const Rig& old,
                                  const std::string& file) {
  try {
    Edit edit(text, file);
    set_timing(rig.sensor, old.sensor, edit);
    set_positions(rig, old, edit);
    set_optics(rig.calibration, old.calibration, edit);
    if (fingerprint(parse_rig(edit.text(), file)) == fingerprint(rig)) return edit.text();
  } catch (const InputError&) {}  // about our own text, which nobody wrote
  return {};
}

}  // namespace

std::string with_calibration(const std::string& text, const Rig& rig, const std::string& file) {
  const Rig old = parse_rig(text, file);
  if (!same_lamps(rig, old)) {
    throw InputError(file, "has changed: its lamps are no longer those that were calibrated",
                     "calibrate again");
  }
  const std::optional<std::string> result = edited(text, rig, old, file);
  if (!result) {
    throw InputError(file, "is written in a way that results cannot be put into",
                     "write [calibration], [sensor] and [[lamps]] as tables with headers of their own");
  }
  return *result;
}

void store_calibration(const Rig& rig, const std::filesystem::path& file) {
  edit_file(file, kMaxRigFileBytes,
            [&](const std::string& text) { return with_calibration(text, rig, file.string()); });
}

}  // namespace rakelight
