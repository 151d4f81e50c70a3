// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Procedural objects, in object coordinates: x right, y down, z away from the viewer, about 2 units large.
// `detail` is the number of image pixels the object spans: facets stay near half a pixel (normals are smooth).
#pragma once

#include "simulate/mesh.h"

namespace rakelight {

/// A thrown vase: mouldings, gadroons, a fluted neck and an embossed band of rosettes and leaves.
SceneMesh make_vase(int detail);

/// A medal: a profile head in low relief, lettering, a beaded and a raised rim, a reeded edge.
SceneMesh make_coin(int detail);

/// A round cloth that fell on a ball and hangs in folds that hide one another.
SceneMesh make_drape(int detail);

/// Unit sphere about the origin.
SceneMesh make_sphere(int detail);

/// A 2 x 2 square through the origin that faces the camera.
SceneMesh make_plane();

}  // namespace rakelight
