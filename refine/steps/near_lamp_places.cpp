// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_places.h"

#include <cmath>
#include <opencv2/core/utility.hpp>

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

PlaceTable::PlaceTable(std::vector<LampPlace> candidates, const LampScene& scene,
                       const SurfacePoints& surface)
    : places(std::move(candidates)), value(surface.rows(), places.size()) {
  cv::parallel_for_(cv::Range(0, static_cast<int>(places.size())), [&](const cv::Range& range) {
    Lamp lamp;
    for (auto k = static_cast<size_t>(range.start); k < static_cast<size_t>(range.end); ++k) {
      lamp.direction = places[k].direction;
      lamp.inverse_distance = places[k].inverse_distance;
      kernels::near_incidence(near_light(lamp, scene), surface.runs(), surface.rows(),
                              value.col(static_cast<Eigen::Index>(k)).data());
    }
  });
  square = value.cwiseAbs2();
}

}  // namespace rakelight
