// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the sensor's noise allows a refined surface to be (the discrepancy principle). A correction is noise taken away:
// it is of the noise's size. Where it is larger, the surface was moved by what the model does not know (paint, a shadow),
// and where there was no reading nothing confirms it.
#pragma once

#include <Eigen/Core>

#include "refine/problem.h"

namespace rakelight {

/// Share of the pixels with a reading that lie more than five deviations of a reading from the start: hardly one in a
/// million if the corrections take away Gaussian noise and nothing else.
double share_beyond_noise(const RefineProblem& problem, const Eigen::VectorXd& zeta);

/// zeta with its correction c = zeta - start bounded to c / sqrt(1 + (h c / sigma)^2), sigma the deviation of a reading;
/// h is 1 where there was no reading and falls to 0 some pixels away from there, or is 1 everywhere.
/// @return log depth [pixel]
Eigen::VectorXd bounded_by_noise(const RefineProblem& problem, const Eigen::VectorXd& zeta, bool everywhere);

}  // namespace rakelight
