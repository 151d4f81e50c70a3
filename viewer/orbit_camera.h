// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The camera that turns around the object. World coordinates are the sensor's: x right, y down, z forward, metres;
// view coordinates are OpenGL's: x right, y up, z to the viewer.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "viewer/surface.h"

namespace rakelight {

struct OrbitCamera {
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< what it looks at and turns around
  double azimuth = 0;    ///< radians; 0: from where the sensor was; positive: the viewer walks to the right
  double elevation = 0;  ///< radians, -pi/2 to pi/2; positive: the viewer rises
  double distance = 1;   ///< to the target, metres
  double fov_y = 0.5;    ///< full vertical angle, radians
  bool orthographic = false;  ///< the same size at the target as in perspective
};

enum class StandardView { front, back, left, right, top, bottom };

/// World to view coordinates.
Eigen::Matrix4d view_matrix(const OrbitCamera& camera);

/// View to clip coordinates. @param aspect width / height  @param scene a box that must lie between near and far plane
Eigen::Matrix4d projection_matrix(const OrbitCamera& camera, double aspect, const Box& scene);

/// Turns by a mouse movement, in shares of the picture's height (y down): half a turn a height.
void orbit(OrbitCamera& camera, double dx, double dy);

/// Moves so that the target follows the mouse, in shares of the picture's height (y down).
void pan(OrbitCamera& camera, double dx, double dy);

/// Comes nearer (factor below 1) or goes away, keeping the point under (x, y) in place; x, y in shares of the height
/// from the picture's middle (y down).
void zoom(OrbitCamera& camera, double factor, double x = 0, double y = 0);

/// Looks at the middle of the box from where it stands, so near that the box just fits.
void fit(OrbitCamera& camera, const Box& box, double aspect);

/// Turns to a standard view; the target and the distance stay.
void turn_to(OrbitCamera& camera, StandardView view);

/// A ray from the eye through (x, y), in normalised device coordinates (-1 to 1, y up); world coordinates.
struct Ray {
  Eigen::Vector3d origin, direction;  ///< direction of unit length
};
Ray ray_through(const OrbitCamera& camera, double aspect, double x, double y);

/// Where a world point lies in normalised device coordinates; empty behind the eye.
std::optional<Eigen::Vector2d> project(const OrbitCamera& camera, double aspect,
                                       const Eigen::Vector3d& point);

}  // namespace rakelight
