// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Everything a virtual rig can be told, and its JSON text: what the program hands to the virtual sensor's driver.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "simulate/options.h"
#include "simulate/virtual_sensor/frame_schedule.h"
#include "simulate/virtual_sensor/lamp_timeline.h"

namespace rakelight {

struct VirtualLamp {
  std::string id;
  LampColor color = LampColor::white;
  std::optional<Eigen::Vector3d> position_m;  ///< camera coordinates; empty: far away, on a ring
};

struct VirtualSensorSetup {
  SceneKind scene = SceneKind::vase;
  AlbedoKind albedo = AlbedoKind::pattern;
  std::uint64_t seed = 1;
  cv::Size color_size{640, 480}, depth_size{640, 480};
  ColorResponse response;
  double crosstalk = 0;           ///< as ImageOptions::crosstalk
  double readout_us = 30000;      ///< first to last row of the rolling shutter
  bool ignores_exposure = false;  ///< the camera says yes to exposure and gain, and does nothing
  int unplug_at_frame = -1;       ///< the sensor vanishes instead of delivering this colour frame
  std::vector<VirtualLamp> lamps;
  LampWiring wiring;  ///< faults of the lamps
  FrameScheduleOptions frames;
};

/// The JSON text has an object's members named as the members here, lamps in faults named by id; what is missing keeps
/// its default. @throws InputError for anything that is not understood.
VirtualSensorSetup parse_virtual_setup(const std::string& text);

}  // namespace rakelight
