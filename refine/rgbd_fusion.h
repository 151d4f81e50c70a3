// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RGBD-Fusion, the paper's baseline (Or-El et al., CVPR 2015): any one image.
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Preset paper: light (9), albedo (10), local term, depth by relinearisation. Robust: refine_by_shading with one light
/// for all channels, in which the smoothness of depth is carried by sensor and image alike (refine/shading.h).
/// @param problem with exactly one image
MethodResult refine_rgbd_fusion(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration);

}  // namespace rakelight
