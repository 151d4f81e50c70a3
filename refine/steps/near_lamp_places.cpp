// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_places.h"

#include <cmath>

#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {

void add_places(const Eigen::Vector3f& direction, std::vector<LampPlace>& places) {
  for (const float inverse_distance : {0.0f, 0.5f, 1.0f, 1.4f, 1.8f, 2.3f, 2.8f})
    places.push_back({direction, inverse_distance});
}

std::vector<LampPlace> places_everywhere() {
  constexpr int kDirections = 150;  // about 12 degrees apart
  const double turn = M_PI * (3 - std::sqrt(5.0));
  std::vector<LampPlace> places;
  for (int k = 0; k < kDirections; ++k) {
    const double z = -(k + 0.5) / kDirections, r = std::sqrt(1 - z * z);
    add_places(Eigen::Vector3d(r * std::cos(turn * k), r * std::sin(turn * k), z).cast<float>(), places);
  }
  return places;
}

PlaceTable::PlaceTable(std::vector<LampPlace> candidates, const SurfaceState& state,
                       const std::vector<int>& pixels)
    : places(std::move(candidates)), value(pixels.size(), places.size()) {
  Lamp lamp;
  for (size_t k = 0; k < places.size(); ++k) {
    lamp.direction = places[k].direction;
    lamp.inverse_distance = places[k].inverse_distance;
    for (size_t j = 0; j < pixels.size(); ++j)
      value(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) =
          incidence_of(lamp, kNoTangents, state.points.col(pixels[j]) - state.scene.center,
                       state.normals.col(pixels[j]), state.scene.lobe_exponent, false)
              .value;
  }
}

}  // namespace rakelight
