// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two mesh formats, from bytes to vertices and triangles; read_mesh (mesh_io.h) checks the rest.
#pragma once

#include <filesystem>
#include <string>

#include "simulate/mesh.h"

namespace rakelight {

/// @param file for messages. Fills vertices and triangles only. @throws InputError
SceneMesh parse_ply(const std::string& bytes, const std::filesystem::path& file);
SceneMesh parse_obj(const std::string& bytes, const std::filesystem::path& file);

}  // namespace rakelight
