// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/objects/objects.h"
#include "simulate/objects/parametric_grid.h"

namespace rakelight {

SceneMesh make_sphere(int detail) {
  const GridShape shape{3 * detail, 3 * detail / 2, true};
  SceneMesh mesh = parametric_grid(shape, [](double s, double t) {
    const double longitude = 2 * M_PI * s;
    const double latitude = M_PI * (t - 0.5);
    const Eigen::Vector3d p{std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                            std::cos(latitude) * std::cos(longitude)};
    return SurfacePoint{p, {longitude - M_PI, latitude}};
  });
  mesh.normals = mesh.vertices;  // exact on a unit sphere
  return mesh;
}

}  // namespace rakelight
