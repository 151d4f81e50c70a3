// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1, the RGBD-Fusion-like method: any one image.
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Preset paper: Eq. (8)-(14). Robust: refine_by_shading (refine/shading.h) with one light for all channels.
/// @param problem with exactly one image
MethodResult refine_fusion_like(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration);

}  // namespace rakelight
