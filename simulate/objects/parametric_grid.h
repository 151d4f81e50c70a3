// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A parametric surface turned into a fine triangle mesh.
#pragma once

#include <functional>

#include "simulate/mesh.h"

namespace rakelight {

struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector2d texture;
};

struct GridShape {
  int columns = 2, rows = 2;    ///< vertices along s and t
  bool closed_columns = false;  ///< s = 0 and s = 1 are one seam
};

/// Samples `surface(s, t)`, s and t in [0, 1], and takes normals from the neighbouring samples.
/// `surface` is called from several threads.
SceneMesh parametric_grid(const GridShape& shape,
                          const std::function<SurfacePoint(double s, double t)>& surface);

/// Puts the second mesh beside the first.
void append(SceneMesh& mesh, const SceneMesh& other);

}  // namespace rakelight
