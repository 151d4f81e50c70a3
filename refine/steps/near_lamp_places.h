// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {

/// Where a lamp may stand, seen from the object's centre.
struct LampPlace {
  Eigen::Vector3f direction;
  float inverse_distance = 0;  ///< 1/m
};

/// Adds one at each of some distances in a direction, far away among them.
void add_places(const Eigen::Vector3f& direction, std::vector<LampPlace>& places);

/// All over the camera's half of the space about the object.
std::vector<LampPlace> places_everywhere();

/// Places and what a lamp of strength 1 sends from each to some surface points; it is the same for every image.
struct PlaceTable {
  std::vector<LampPlace> places;
  Eigen::MatrixXf value;   ///< [row of the surface points, place] max(0, v.n)
  Eigen::MatrixXf square;  ///< of the value

  PlaceTable(std::vector<LampPlace> candidates, const LampScene& scene, const SurfacePoints& surface);
};

}  // namespace rakelight
