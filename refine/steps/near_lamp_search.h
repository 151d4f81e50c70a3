// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "refine/observations.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Looks for each near lamp of the state all over the space before the object, given shape and albedo: a start that no
/// local minimum holds back. @return the state's lamps, the near ones where they explain their image best
std::vector<Lamp> search_near_lamps(const Observations& images, const SurfaceState& state);

}  // namespace rakelight
