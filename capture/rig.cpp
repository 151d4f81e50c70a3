// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/rig.h"

#include <cmath>
#include <cstdio>

namespace rakelight {
namespace {

/// Where a lamp of the virtual rig stands, to the millimetre: 8 m from the object's centre, which is 1 m before the camera.
/// @param angle_deg from the optical axis  @param turn share of a turn about it
Eigen::Vector3d lamp_place(double angle_deg, double turn) {
  const double angle = angle_deg * M_PI / 180, azimuth = 2 * M_PI * turn;
  const Eigen::Vector3d direction(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                                  -std::cos(angle));
  const Eigen::Vector3d place = Eigen::Vector3d(0, 0, 1) + 8.0 * direction;
  return (1000 * place).array().round() / 1000;
}

}  // namespace

Rig virtual_rig() {
  Rig rig;
  rig.sensor.uri = "virtual";
  rig.rgb_shot = true;
  rig.virtual_rig.emplace();
  constexpr int kWhiteLamps = 12;
  for (int k = 0; k < kWhiteLamps; ++k) {
    char id[16];
    std::snprintf(id, sizeof id, "white-%02d", k);
    rig.lamps.push_back(
        {id, LampColor::white, {}, lamp_place(k % 2 == 0 ? 48 : 32, (k + 0.3) / kWhiteLamps)});
  }
  for (const LampColor color : {LampColor::red, LampColor::green, LampColor::blue}) {
    const int third = color == LampColor::red ? 0 : color == LampColor::green ? 1 : 2;
    rig.lamps.push_back({to_string(color), color, {}, lamp_place(40, third / 3.0)});
  }
  for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
    rig.lamps[k].line.chip = "virtual";
    rig.lamps[k].line.offset = static_cast<unsigned>(k);
  }
  return rig;
}

}  // namespace rakelight
