// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The object, placed before the camera.
#pragma once

#include "simulate/mesh.h"
#include "simulate/options.h"

namespace rakelight {

/// Turns, centres and scales a mesh so that it stays within `fill` of the view and its bounding box is centred on the
/// optical axis at `distance_m`. In: object coordinates; out: camera coordinates, metres.
void place(SceneMesh& mesh, const SceneOptions& options, const Camera& camera);

/// Builds or reads the scene's mesh and places it. @throws InputError for a mesh file that cannot be used.
SceneMesh make_scene(const SceneOptions& options, const Camera& camera);

}  // namespace rakelight
