// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far each pixel's depth and normal can be trusted: a dependent wild bootstrap of the last depth step (X. Shao, "The
// Dependent Wild Bootstrap", JASA 2010).
//
// Near the minimum the depth answers to its data linearly: H dz = change of the right-hand side. The data's own residuals
// are their best known errors, so they are multiplied by random numbers of mean 0 and variance 1, the system is solved for
// that change, and the spread of the solutions over some draws is the error bar.
//   Sensor: reading minus refined depth, times a smooth random field. Errors keep their local size, at jumps and rims too,
//           and are correlated over the field's reach, as those of block matching are.
//   Images: image minus model, times one number an image: what highlights, shadows and a wrong lamp do differs from lamp to
//           lamp and is broad within one. The albedo follows. Errors that all images share leave no residual that tells
//           them; they are taken to be in proportion (kSharedErrors).
//   Normals, besides: relief near the pixel's size, which no grid can hold, shows as change between neighbours.
#pragma once

#include "refine/observations.h"
#include "refine/steps/depth_step.h"
#include "refine/surface_state.h"

namespace rakelight {

/// One standard deviation of each pixel.
struct Uncertainty {
  Eigen::VectorXd depth;   ///< metres
  Eigen::VectorXd normal;  ///< radians, root mean square angle
};

/// @param depth the last step's problem  @param scale refined grid / depth grid
/// @param images, state what the problem's tensors were made of  @param draws of the bootstrap; 0: an empty result
/// The draws are the same at every call: the result is reproducible.
Uncertainty estimate_uncertainty(const DepthProblem& depth, int scale, const Observations& images,
                                 const SurfaceState& state, int draws);

}  // namespace rakelight
