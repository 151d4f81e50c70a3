// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 2, the RGB ratio model: one image under red, green and blue lamps at once.
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Preset paper: Eq. (17)-(24) with the errata. Robust: the same data by refine_by_shading (refine/shading.h).
/// @param problem with exactly one image, lit in three colours
MethodResult refine_rgb_ratio(const RefineProblem& problem, const RefineOptions& options,
                              const IterationCallback& after_iteration);

}  // namespace rakelight
