// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a person has set in the window: everything that keys and mouse change.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "viewer/look.h"
#include "viewer/orbit_camera.h"

namespace rakelight {

enum class Tool {
  none,
  distance,  ///< two clicks measure
  profile,   ///< two clicks cut
};

struct ViewState {
  Look look;
  OrbitCamera camera;
  Box bounds;         ///< of the scene
  double aspect = 1;  ///< of the drawing, width / height
  Tool tool = Tool::none;
  std::vector<Eigen::Vector3d> points;  ///< clicked with a tool, camera coordinates, metres; at most two
  bool light_follows_mouse = true;
  bool show_panel = true, show_keys = false, show_frames = false, show_convergence = false;
  bool wants_picture = false, wants_quit = false;
  std::string status;  ///< one line for the person
};

/// Length of the measured line, millimetres; 0 before two points are there.
double measured_mm(const ViewState& state);

/// Adds a clicked point for the tool in hand; a third one starts anew. @param what it was clicked on, metres
void add_point(ViewState& state, const Eigen::Vector3d& point);

}  // namespace rakelight
