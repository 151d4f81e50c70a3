// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A round cloth that falls on a ball, by position-based dynamics (Mueller et al., 2007). Always the same cloth.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rakelight {

struct ClothOptions {
  int nodes = 80;       ///< a side of the grid that is bent into a disc
  double radius = 1.3;  ///< of the cloth; the ball's is 0.62, its centre the origin
  int steps = 340;
  int sweeps = 11;               ///< over all constraints, a step
  double bend_stiffness = 0.05;  ///< share of a bending error undone a sweep
};

/// Where the point (s, t), both in [0, 1], of the grid lies on the flat cloth, about its centre.
Eigen::Vector2d flat_point(const ClothOptions& options, double s, double t);

/// Node positions, row by row, y down. Only its own weight, the ball and its threads act on the cloth.
std::vector<Eigen::Vector3f> fallen_cloth(const ClothOptions& options);

}  // namespace rakelight
