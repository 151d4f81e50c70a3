// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The few colours an object is painted with, found as modes of its pixels in log RGB (mean shift). Patches of one paint
// far apart then agree on its albedo, which smoothness between neighbours cannot bring about.
#pragma once

#include <Eigen/Core>

namespace rakelight {

struct PalettePull {
  Eigen::Matrix3Xd color;  ///< [pixel] log albedo of the nearest mode
  Eigen::VectorXd trust;   ///< [pixel] 1 at the mode, falling to 0 beyond the bandwidth
};

/// Modes of the columns (log RGB) under a flat kernel of radius `bandwidth`; modes that few pixels support are left out.
/// @return 3 x modes
Eigen::Matrix3Xd palette_modes(const Eigen::Matrix3Xd& log_albedo, double bandwidth);

/// What pulls each pixel to its mode. @param bandwidth in natural logarithms: .25 is a ratio of 1.28
PalettePull palette_pull(const Eigen::Matrix3Xd& log_albedo, double bandwidth);

}  // namespace rakelight
