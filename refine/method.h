// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every method takes and gives.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "refine/problem.h"
#include "refine/refine.h"
#include "refine/steps/near_lamps.h"
#include "refine/steps/uncertainty.h"
#include "refine/surface_state.h"

namespace rakelight {

struct MethodResult {
  SurfaceState state;
  std::vector<IterationReport> iterations;
  Termination termination = Termination::max_iterations;
  std::string message;  ///< one sentence on how it ended
  std::vector<std::string> warnings;
  std::map<std::string, double> quality;          ///< named measures
  Uncertainty uncertainty;                        ///< empty where the method gives none
  std::vector<LampUncertainty> lamp_uncertainty;  ///< [image]; empty where all lamps are far
};

/// Called after each outer iteration with its number, the share done and log z [pixel] (m); throws Cancelled to stop.
using IterationCallback =
    std::function<void(int iteration, double fraction_done, const Eigen::VectorXd& zeta)>;

/// The state every method starts from: the sensor's shape, white, every usable sample trusted, no lamps yet.
SurfaceState initial_state(const RefineProblem& problem, const RefineOptions& options);

/// Root mean square change of depth between two states of zeta = log z, mm.
double rms_change_mm(const Eigen::VectorXd& before, const Eigen::VectorXd& after);

/// The same as most pixels have it: a robust deviation, from the median of a fixed choice of pixels. A few at a frayed rim may
/// flip to and fro by centimetres for ever.
double typical_change_mm(const Eigen::VectorXd& before, const Eigen::VectorXd& after);

}  // namespace rakelight
