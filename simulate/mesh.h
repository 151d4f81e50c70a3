// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangle meshes with smooth normals and texture coordinates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace rakelight {

/// Vertices, normals and texture coordinates run in parallel. Winding does not matter: surfaces are two-sided.
struct SceneMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  ///< unit length, for smooth shading
  std::vector<Eigen::Vector2f> texture;  ///< where the albedo is looked up, object's half size = 1
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Normals of vertices as the area-weighted mean of their triangles'.
std::vector<Eigen::Vector3f> smooth_normals(const SceneMesh& mesh);

/// Mean length of the triangles' edges; 0 without triangles.
double mean_edge_length(const SceneMesh& mesh);

}  // namespace rakelight
