// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Curves over the drawing: profiles before and after, convergence.
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "viewer/profile.h"
#include "viewer/view_state.h"

namespace rakelight {

struct Curve {
  std::string name;
  cv::Vec3b color;
  std::vector<cv::Point2d> points;  ///< gaps where y is NaN
};

/// A plot that fills the Dear ImGui window it is called in. @param x_label, y_label with units
void draw_plot(const std::vector<Curve>& curves, const std::string& x_label, const std::string& y_label);

/// The profile along the two clicked points, of the layers before and after.
void draw_profile(const ViewState& state, const Scene& scene);

/// Energy and depth change an iteration, on logarithmic axes.
void draw_convergence(ViewState& state, const Scene& scene);

}  // namespace rakelight
