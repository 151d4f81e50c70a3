// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The point of a surface under the mouse.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "viewer/orbit_camera.h"
#include "viewer/surface.h"

namespace rakelight {

struct Picked {
  Eigen::Vector3d point;  ///< on the surface, camera coordinates, metres
  cv::Point pixel;        ///< the nearest one of the layer's grid
};

/// Where the ray first meets a triangle of the surface, from whichever side; empty if it misses.
std::optional<Picked> pick(const Surface& surface, const Ray& ray);

}  // namespace rakelight
