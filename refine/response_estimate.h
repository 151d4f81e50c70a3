// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What colour values mean, from the images themselves: the exponent that makes them consistent with the lighting model.
#pragma once

#include <functional>
#include <string>

#include "refine/options.h"
#include "stack/stack.h"

namespace rakelight {

struct ResponseEstimate {
  double gamma = 1;  ///< radiance = value^gamma
  double deviation =
      0;  ///< one standard deviation of it: spread over images left out in turn, and the model's own
          ///< bias; NaN where no exponent tried is clearly the best
  bool sure = false;  ///< the images determine it
  ColorResponse
      used;  ///< what to decode with: the estimate if it is sure and contradicts the stack, else the stack's
  std::string message;  ///< e.g. "response: gamma 2.19 +- 0.10"
};

/// Needs a good range of normals and light, and six images under different lamps; says so where it is not sure.
/// @param progress gets the share done; false cancels  @throws InputError as make_problem, Cancelled.
ResponseEstimate estimate_response(const LightStack& stack, const RefineOptions& options,
                                   const std::function<bool(double)>& progress = {});

}  // namespace rakelight
