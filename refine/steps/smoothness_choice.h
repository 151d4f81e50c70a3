// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How smooth the surface is, asked of the image. Surfaces are made of the sensor's depth and the smoothness prior alone,
// at strengths a few times apart, and the image, which none of them has seen, says which it supports
// (refine/steps/image_agreement.h).
#pragma once

#include <optional>

#include "refine/options.h"
#include "refine/problem.h"
#include "refine/steps/curvature_prior.h"

namespace rakelight {

struct SmoothnessChoice {
  double share = 1;  ///< of the smoothness given, from 0.03 to 1
  double gain = 0;   ///< 1 - disagreement of the chosen surface / that of the start
};

/// @param broad_normals of the start, smoothed: what the light is fitted to
/// @param prior of weight 1 a reading  @param balance lambda_z / lambda_l of the full smoothness, on log z
/// @return nothing when a system was singular
std::optional<SmoothnessChoice> choose_smoothness(const RefineProblem& problem, const DepthPrior& prior,
                                                  const CurvaturePrior& curvature, DepthSolver& solver,
                                                  const Eigen::Matrix3Xf& broad_normals, double balance);

}  // namespace rakelight
