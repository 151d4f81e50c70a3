// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "refine/steps/near_lamp_equations.h"

namespace rakelight {

/// The lamps of a rig are LEDs of one kind: their power differs by this share (a natural logarithm) in the usual rig. Bins of
/// one LED differ by 0.1; the rest allows for a lamp that is not aimed at the object, or of another kind.
constexpr double kLogPowerDeviation = 0.7;

/// log of a near lamp's power up to a constant: strength / (kappa^2 + kappa_0^2), mean over channels. A lamp beyond 1 / kappa_0 =
/// 3 m is taken as if it stood there, for nothing tells how far it is.
double log_lamp_power(const Lamp& lamp);

/// What is known of a rig beforehand, against image errors of variance `variance`: little ambient light, little gloss, lamps
/// that light the object about alike, and axes that meet in its middle. It decides only where the images do not.
/// @param middle of the seen surface, metres
NearLampEquations near_lamp_prior(const NearLampUnknowns& at, const Eigen::Vector3f& middle, double variance);

}  // namespace rakelight
