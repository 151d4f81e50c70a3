// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// RGBD-Fusion, the paper's baseline (Or-El et al., CVPR 2015): any one image.
#pragma once

#include "refine/method.h"

namespace rakelight {

/// Preset paper: light (9), albedo (10), local term beta, depth by relinearisation. Robust: the very call of fusion-like
/// (refine/shading.h): the two methods differ in beta alone, which takes up what lamp and albedo do not explain, and
/// there the weights that spare samples of large residual do that. The results are equal.
/// @param problem with exactly one image
MethodResult refine_rgbd_fusion(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration);

}  // namespace rakelight
