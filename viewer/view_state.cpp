// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/view_state.h"

namespace rakelight {

double measured_mm(const ViewState& state) {
  return state.points.size() == 2 ? 1000 * (state.points[1] - state.points[0]).norm() : 0;
}

void add_point(ViewState& state, const Eigen::Vector3d& point) {
  if (state.tool == Tool::none) return;
  if (state.points.size() == 2) state.points.clear();
  state.points.push_back(point);
}

}  // namespace rakelight
