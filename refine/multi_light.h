// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 3, the robust multi-light method, with super-resolution (Sec. III-C, III-D).
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Alternates lamps (26), albedo (27), robust weights and depth (32), (34) until the depth (robust) or the energy
/// (paper) settles. @throws InputError when there are fewer than 4 images or their lamps'
/// directions do not determine the shape.
MethodResult refine_multi_light(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration);

}  // namespace rakelight
