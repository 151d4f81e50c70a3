// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/objects/objects.h"
#include "simulate/objects/parametric_grid.h"

namespace rakelight {

SceneMesh make_plane() {
  return parametric_grid({2, 2, false}, [](double s, double t) {
    const Eigen::Vector2d xy{2 * s - 1, 2 * t - 1};
    return SurfacePoint{{xy.x(), xy.y(), 0}, xy};
  });
}

}  // namespace rakelight
