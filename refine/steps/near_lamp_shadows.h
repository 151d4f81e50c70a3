// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "refine/steps/near_lamp_samples.h"

namespace rakelight {

/// Weighs all usable samples anew by how far the state, its albedo fitted, and the gloss miss them: (1 + (r / scale)^2)^-2,
/// scale a robust deviation of the image's residuals. That all but forgets shadows, while a share of the many samples in
/// shadow would turn the lamps; a start that is far off it would hold where it is.
void forget_shadows(const SurfaceState& state, const Gloss& gloss, std::vector<LampRegion>& regions);

}  // namespace rakelight
