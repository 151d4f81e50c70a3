// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/fusion_like.h"

#include "refine/shading.h"

namespace rakelight {

MethodResult refine_fusion_like(const RefineProblem& problem, const RefineOptions& options,
                              const IterationCallback& after_iteration) {
  return refine_by_shading(problem, options, ImageLight::white, after_iteration);
}

}  // namespace rakelight
