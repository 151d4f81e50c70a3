// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pull towards the sensor's depth (refine/steps/super_resolution.h) over runs of pixels, in double precision.
#pragma once

namespace rakelight::kernels {

/// Pointers to a run's first pixel.
struct PriorRun {
  const double *zeta, *start;     ///< log depth
  const double *target, *weight;  ///< of cells of one pixel each; not read otherwise
  double floor;
};

/// Sum of weight (target - zeta)^2 + floor (start - zeta)^2, the first part only with `cells`.
double prior_energy(const PriorRun& run, bool cells, int count);

/// Adds weight + floor to the diagonal and weight (target - zeta) + floor (start - zeta) to the right-hand side.
/// @return the energy
double add_prior(const PriorRun& run, bool cells, int count, float* diagonal, float* rhs);

}  // namespace rakelight::kernels
