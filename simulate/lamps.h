// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lamps of the rig and what of their light arrives.
#pragma once

#include <vector>

#include "simulate/options.h"

namespace rakelight {

/// One image: the lamps lit for it. No lamp: a dark frame.
struct LampSet {
  Light light;  ///< what the stack records; meaningless when `lamps` is empty
  std::vector<LampTruth> lamps;
};

/// The sequence of images: dark frame, RGB at once, white lamps in turn, as asked. Strengths are relative (about 1).
std::vector<LampSet> make_lamp_sets(const SimulateOptions& options);

/// White lamp k of `options.lamps.count`.
LampSet white_lamp(const SimulateOptions& options, int k);

/// Lamp k of `count` that light one channel only (0 red, 1 green, 2 blue): those of the three channels stand a third
/// of their own spacing apart. Far, or `options.lamps.distance_m` away.
LampTruth channel_lamp(const SimulateOptions& options, int channel, int k, int count);

/// Direction to a lamp and its irradiance on a facing surface at a point (camera coordinates, metres).
/// Near lamps: strength x cos(angle to the lamp's axis) x (R / r)^2, R = the distance of the object's centre.
struct Incident {
  Eigen::Vector3f direction;   ///< unit, from the point to the lamp
  Eigen::Vector3f irradiance;  ///< linear RGB
  float distance;              ///< to the lamp, metres; infinite for far lamps
};
Incident incident_light(const LampTruth& lamp, const Eigen::Vector3f& object_center,
                        const Eigen::Vector3f& point);

}  // namespace rakelight
