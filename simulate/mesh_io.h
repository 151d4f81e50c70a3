// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangle meshes from files.
#pragma once

#include <filesystem>

#include "simulate/mesh.h"

namespace rakelight {

/// Reads a PLY (ascii or binary little-endian; faces or triangle strips) or OBJ file whose axes are x right, y up, z to
/// the viewer, and turns it to object coordinates (y down, z away). Normals are the smooth ones of the triangles;
/// texture coordinates are x and y, half size 1. Counts are checked against the file's size before allocation.
/// @throws InputError naming the file, the fault and the cure.
SceneMesh read_mesh(const std::filesystem::path& file);

}  // namespace rakelight
