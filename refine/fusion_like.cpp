// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/fusion_like.h"

#include "refine/fusion_paper.h"
#include "refine/shading.h"

namespace rakelight {

MethodResult refine_fusion_like(const RefineProblem& problem, const RefineOptions& options,
                                const IterationCallback& after_iteration) {
  if (options.preset == Preset::robust)
    return refine_by_shading(problem, options, ImageLight::white, after_iteration);
  FusionModel model;  // Table I's 500 and 2 fit metres with the Laplacian of slopes best
  return refine_fusion_as_printed(problem, options, model, after_iteration);
}

}  // namespace rakelight
