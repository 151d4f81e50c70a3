// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes for web viewers (binary glTF 2.0).
#pragma once

#include <string>

#include "refine/output/mesh.h"

namespace rakelight {

/// A mesh for the web has at most this many vertices (some 56 MB).
inline constexpr int kMaxGlbVertices = 1'000'000;

/// The bytes of a .glb file: positions (metres) and normals as float, colours as linear RGB in 16 bits, the frame glTF
/// wants: x right, y up, z towards the viewer, the camera at the origin. No extension is needed to read it.
std::string glb_bytes(const Mesh& mesh);

}  // namespace rakelight
