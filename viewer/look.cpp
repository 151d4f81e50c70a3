// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/look.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLowestDeg = 3;  ///< at 0 only slopes towards the light would be lit

}  // namespace

std::array<float, 3> light_direction(const LightAngles& light) {
  const double azimuth = light.azimuth_deg * kPi / 180, elevation = light.elevation_deg * kPi / 180;
  return {static_cast<float>(std::cos(azimuth) * std::cos(elevation)),
          static_cast<float>(std::sin(azimuth) * std::cos(elevation)),
          static_cast<float>(std::sin(elevation))};
}

LightAngles light_at(double x, double y) {
  const double radius = std::min(1.0, std::hypot(x, y));
  // Steeper than acos(radius): most of the window then gives a raking light.
  return {std::atan2(y, x) * 180 / kPi, std::max(kLowestDeg, 90 * std::pow(1 - radius, 1.5))};
}

}  // namespace rakelight
