// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/rgbd_fusion.h"

#include "refine/fusion_paper.h"
#include "refine/shading.h"

namespace rakelight {

MethodResult refine_rgbd_fusion(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration) {
  if (options.preset == Preset::robust)
    return refine_by_shading(problem, options, ImageLight::white, after_iteration);
  FusionModel model;
  model.unit_m = 1e-3;  // Table I's .004 and .0075 mean millimetres
  model.slope_smoothness = false;
  model.local_term = true;
  return refine_fusion_as_printed(problem, options, model, after_iteration);
}

}  // namespace rakelight
