// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The photometric rows of the paper's single-image depth systems (refine/steps/gradient_rows.h).
#pragma once

#include <vector>

#include "refine/observations.h"
#include "refine/steps/gradient_rows.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Eq. (22), three rows a pixel: v . n = 0 for each pair of channels. The length of n cancels, which leaves
/// v . (f zeta_x, f zeta_y, -x~ zeta_x - y~ zeta_y) = v_z: the constant that Eq. (23) lost.
/// @param image one image  @param state its albedo and one far lamp are used
std::vector<GradientRow> ratio_rows(const PixelGrid& grid, const Observations& image,
                                    const SurfaceState& state);

/// Eq. (14), one row a pixel: rho (l . n + phi) = I with orthographic normals of slopes k grad z and their length as it is
/// at z. @param lamp far; its first channel counts  @param k metric slope of one unit of z between neighbours
std::vector<GradientRow> shading_rows(const PixelGrid& grid, const CornerList& corners, const Lamp& lamp,
                                      const Eigen::VectorXd& rho, const Eigen::VectorXd& I,
                                      const Eigen::VectorXd& z, double k);

/// Eq. (4) with slopes k grad z.
Eigen::Matrix3Xf orthographic_normals(const PixelGrid& grid, const CornerList& corners,
                                      const Eigen::VectorXd& z, double k);

}  // namespace rakelight
