// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/mesh_io.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <string>

#include "simulate/mesh_formats.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{4} << 30;

std::string read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw InputError(file.string(), "cannot be read (" + error.message() + ")", "check the path");
  if (size > kMaxFileBytes) throw InputError(file.string(), "is larger than 4 GB", "simplify the mesh");
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    throw InputError(file.string(), "cannot be read", "check its permissions");
  }
  return bytes;
}

void check(const std::filesystem::path& file, const SceneMesh& mesh) {
  constexpr float kLargest = 1e12f;  // squares stay finite in single precision
  for (const auto& v : mesh.vertices) {
    if (!v.allFinite() || v.cwiseAbs().maxCoeff() > kLargest) {
      throw InputError(file.string(), "has a vertex that is not finite", "repair the mesh");
    }
  }
  for (const auto& triangle : mesh.triangles) {
    for (const auto index : triangle) {
      if (index >= mesh.vertices.size()) {
        throw InputError(file.string(), "has a face that names a vertex beyond the last", "repair the mesh");
      }
    }
  }
  if (mesh.triangles.empty())
    throw InputError(file.string(), "has no faces", "give a surface, not a point cloud");
}

/// File axes (y up, z to the viewer) to object axes (y down, z away), centred, half of the longest side = 1.
void to_object_axes(const std::filesystem::path& file, SceneMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const auto& triangle : mesh.triangles) {
    for (const auto index : triangle) box.extend(mesh.vertices[index]);
  }
  const float half = 0.5f * box.sizes().maxCoeff();
  if (!(half > 0)) throw InputError(file.string(), "has no extent", "give a surface, not a point");
  const Eigen::Vector3f center = box.center();
  for (auto& v : mesh.vertices) {
    const Eigen::Vector3f p = (v - center) / half;
    v = {p.x(), -p.y(), -p.z()};
  }
}

/// Vertices without a face must not count for the object's size.
void drop_unused_vertices(SceneMesh& mesh) {
  constexpr auto kUnused = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> renumbered(mesh.vertices.size(), kUnused);
  std::vector<Eigen::Vector3f> used;
  for (auto& triangle : mesh.triangles) {
    for (auto& index : triangle) {
      if (renumbered[index] == kUnused) {
        renumbered[index] = static_cast<std::uint32_t>(used.size());
        used.push_back(mesh.vertices[index]);
      }
      index = renumbered[index];
    }
  }
  mesh.vertices = std::move(used);
}

}  // namespace

SceneMesh read_mesh(const std::filesystem::path& file) {
  const std::string bytes = read_bytes(file);
  const bool is_ply = bytes.compare(0, 3, "ply") == 0;
  if (!is_ply && file.extension() != ".obj" && file.extension() != ".OBJ") {
    throw InputError(file.string(), "is neither PLY nor OBJ", "convert the mesh to one of these");
  }
  SceneMesh mesh = is_ply ? parse_ply(bytes, file) : parse_obj(bytes, file);
  check(file, mesh);
  drop_unused_vertices(mesh);
  to_object_axes(file, mesh);
  mesh.normals = smooth_normals(mesh);
  for (const auto& v : mesh.vertices) mesh.texture.emplace_back(v.x(), v.y());
  return mesh;
}

}  // namespace rakelight
