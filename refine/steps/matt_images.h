// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "refine/observations.h"
#include "refine/steps/highlight.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Writes into `matt` what the state's near lamps and the gloss leave of the radiance seen: images that a matt surface of
/// this shape would show. Usability, names and positions stay. @param matt of the same pixels and images
void take_off_highlights(const Observations& seen, const SurfaceState& state, const Gloss& gloss,
                         Observations& matt);

}  // namespace rakelight
