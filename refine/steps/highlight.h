// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Highlights, as far as the lamps' fit needs to know of them: I = rho (e max(0, v.n) + phi) + e |v| sum_j gloss_j (n.h)^m_j
// with h half-way between lamp and eye (Blinn-Phong lobes; kernels::highlight_lobes). They have the lamp's colour whatever
// the paint. The flanks of a highlight are too faint to be told from noise pixel by pixel, but all lean the same way, and a
// fit that knows nothing of them turns its lamps by many degrees: on a flat object most.
//
// Exponents m_j 16 and 64: half as bright 17 and 8 degrees off the peak. Between and about them two lobes mix to what glossy
// paint, plastic and glaze show; sharper ones are left to the robust weights.
#pragma once

#include <Eigen/Core>

#include "refine/kernels/near_lamp_kernels.h"

namespace rakelight {

constexpr int kHighlightLobes = kernels::kHighlightLobes;

/// Peak radiance of each lobe, share of what a facing surface of albedo 1 reflects of the same light.
using Gloss = Eigen::Matrix<double, kHighlightLobes, 1>;

}  // namespace rakelight
