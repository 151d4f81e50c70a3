// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cut through a surface along a line between two points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "viewer/scene.h"

namespace rakelight {

struct ProfilePoint {
  double along_mm = 0;   ///< from the first point, on the straight line to the second
  double height_mm = 0;  ///< off that line, positive towards the camera; NaN where there is no surface
};

/// The layer over the straight line from a to b, in steps of about one pixel.
/// @param a, b camera coordinates, metres, in front of the camera; they need not lie on this layer
std::vector<ProfilePoint> profile_of(const Layer& layer, const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace rakelight
