// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The synthetic rig: renders a light stack with its truth. Read this header first.
//
//     Simulated scan = simulate_stack(realism_options(Realism::real));
//     write_stack(scan.stack, folder, scan.truth);
#pragma once

#include <functional>

#include "simulate/options.h"
#include "stack/stack.h"

namespace rakelight {

struct Simulated {
  LightStack stack;
  GroundTruth
      truth;  ///< at colour resolution; depth and normals at pixel centres, albedo the mean over the pixel
};

/// Share done, 0 to 1; return false to cancel.
using SimulateProgress = std::function<bool(double fraction_done)>;

/// Renders a scan. The same options give the same bytes on any number of threads.
/// The stack's mask is the set of colour pixels whose centre sees the object.
/// @throws UsageError for options out of range, InputError for a mesh that cannot be used, Cancelled.
Simulated simulate_stack(const SimulateOptions& options, const SimulateProgress& progress = {});

}  // namespace rakelight
