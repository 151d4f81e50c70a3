// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygon files (Stanford PLY, binary little-endian).
#pragma once

#include <string>

#include "refine/output/mesh.h"

namespace rakelight {

/// The bytes of a PLY file: vertices with x y z (metres, camera coordinates), nx ny nz, red green blue and the scalar
/// delta_mm; triangles as `list uchar int vertex_indices`.
std::string ply_bytes(const Mesh& mesh);

}  // namespace rakelight
