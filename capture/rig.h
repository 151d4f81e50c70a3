// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What stands on the table: sensor, lamps, how they are wired, and what calibration has found out about them.
// Rig files (TOML) are read and written by capture/rig_file.h; the defaults here are the virtual rig.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

/// One GPIO line. Either `name`, or `chip` (a label such as "cp2112_gpio" or a name such as "gpiochip0") with `offset`.
struct LineAddress {
  std::string name;
  std::string chip;
  unsigned offset = 0;
  bool active_low = false;
};

struct RigLamp {
  std::string id;
  LampColor color = LampColor::white;
  LineAddress line;
  std::optional<Eigen::Vector3d> position_m;  ///< colour-camera coordinates
};

struct StreamMode {
  int width = 640, height = 480, fps = 30;
};

/// Faults and habits of the virtual rig, so that a scan can be tried against them.
struct VirtualRig {
  std::string scene = "vase";      ///< a scene of `simulate`
  std::string albedo = "pattern";  ///< a paint of `simulate`
  std::uint64_t seed = 1;
  double lamp_latency_us = 2000;       ///< from the write to light
  double lamp_jitter_us = 0;           ///< uniform, on top
  double delivery_latency_us = 15000;  ///< from the end of readout to the host
  double delivery_jitter_us = 2000;
  double drop_share = 0;         ///< share of frames that never arrive
  int unplug_at_frame = -1;      ///< the sensor vanishes at this colour frame
  ColorResponse color_response;  ///< how its pixels encode light
  double crosstalk = 0;          ///< share of a LED's light that leaks into each adjacent channel
  bool lamps_on_lines = false;   ///< real lines switch the virtual lamps: each is lit while its line reads so
  bool ignores_exposure = false;                      ///< says yes to exposure and gain, and does nothing
  std::vector<std::string> stuck_on, stuck_off, dim;  ///< lamp ids
  std::vector<std::array<std::string, 2>> swapped;    ///< pairs of lamp ids wired the wrong way round
};

struct SensorSetup {
  std::string uri;  ///< OpenNI2 URI; empty: the first device; "virtual": the virtual rig
  StreamMode color, depth;
  double exposure_us = 8000;
  double gain = 100;
  double readout_us = 30000;  ///< first to last row of the rolling shutter
  double lamp_jitter_us =
      1000;  ///< of the time from write to light; `rakelight calibrate latency` measures it
};

struct RigCalibration {
  std::optional<Camera> color_camera, depth_camera;
  std::optional<Eigen::Matrix4d> T_color_depth;  ///< depth to colour coordinates, metres
  std::optional<ColorResponse> color_response;
  std::optional<Eigen::Matrix3d> color_crosstalk;
};

struct Rig {
  std::string name = "virtual";
  SensorSetup sensor;
  std::vector<RigLamp> lamps;  ///< in the order of the sequence
  int max_on_ms = 2000;        ///< watchdog
  int repeats = 1;             ///< images a lamp
  bool rgb_shot = false;       ///< one image under the red, green and blue lamps at once
  RigCalibration calibration;
  std::optional<VirtualRig> virtual_rig;  ///< set: sensor and lamps are virtual
};

/// The rig that `scan` uses when no file names another: the virtual sensor, 12 white lamps and one of each colour.
Rig virtual_rig();

}  // namespace rakelight
