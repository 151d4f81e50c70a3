// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "refine/observations.h"
#include "refine/steps/near_lamp_places.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Looks for each near lamp of the state all over the space before the object, given shape and albedo: a start that no
/// local minimum holds back.
class NearLampSearch {
 public:
  /// @param state its surface and scene are those of all searches
  NearLampSearch(const Observations& images, const SurfaceState& state);

  /// @return the state's lamps, the near ones where they explain their image best under the state's albedo
  std::vector<Lamp> lamps(const SurfaceState& state) const;

 private:
  const Observations& images_;
  std::vector<int> pixels_;  ///< some of the surface, evenly spread
  SurfacePoints surface_;
  PlaceTable everywhere_;
};

}  // namespace rakelight
