// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What log depth means in metres, over consecutive pixels.
#pragma once

namespace rakelight::kernels {

/// Rays (x~ / fx, y~ / fy, 1) of consecutive pixels of one row.
struct RayRun {
  float x, y;  ///< of the first pixel
  float step;  ///< of x from pixel to pixel, 1 / fx
  int count;
};

/// Points z (x, y, 1), interleaved, z = scale exp(zeta - origin). @param zeta within some units of the origin
void ray_points(const RayRun& rays, const double* zeta, double origin, float scale, float* points);

/// Sum of (z (after - before))^2 with z = exp((after + before) / 2): the squared change of depth, but for its cube.
double squared_depth_change(const double* before, const double* after, int count);

}  // namespace rakelight::kernels
