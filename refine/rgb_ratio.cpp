// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/rgb_ratio.h"

#include "refine/shading.h"

namespace rakelight {

MethodResult refine_rgb_ratio(const RefineProblem& problem, const RefineOptions& options,
                              const IterationCallback& after_iteration) {
  return refine_by_shading(problem, options, ImageLight::colored, after_iteration);
}

}  // namespace rakelight
