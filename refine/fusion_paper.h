// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (8)-(14) as printed, for Algorithm 1 and for the RGBD-Fusion baseline it simplifies (Or-El et al., CVPR 2015):
// grey image, orthographic normals with metric slopes (grad z f / mean z), the normaliser frozen at the last depth.
#pragma once

#include "refine/method.h"

namespace rakelight {

struct FusionModel {
  double unit_m = 1;             ///< the unit of z that the weights are meant for, metres
  bool slope_smoothness = true;  ///< lambda_l is multiplied by f / mean z
  bool local_term = false;       ///< RGBD-Fusion's beta: what lamp and albedo leave unexplained
};

/// @param problem with exactly one image
MethodResult refine_fusion_as_printed(const RefineProblem& problem, const RefineOptions& options,
                                      const FusionModel& model, const IterationCallback& after_iteration);

}  // namespace rakelight
