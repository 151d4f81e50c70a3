// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/mesh.h"

#include <Eigen/Geometry>

namespace rakelight {

std::vector<Eigen::Vector3f> smooth_normals(const SceneMesh& mesh) {
  std::vector<Eigen::Vector3d> sums(mesh.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d origin = mesh.vertices[a].cast<double>();
    const Eigen::Vector3d weighted =
        (mesh.vertices[b].cast<double>() - origin).cross(mesh.vertices[c].cast<double>() - origin);
    for (const auto index : {a, b, c}) sums[index] += weighted;
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(sums.size());
  for (const auto& sum : sums) {
    const double length = sum.norm();
    normals.push_back(length > 0 ? Eigen::Vector3f((sum / length).cast<float>()) : Eigen::Vector3f(0, 0, -1));
  }
  return normals;
}

double mean_edge_length(const SceneMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += static_cast<double>((mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
    }
  }
  return mesh.triangles.empty() ? 0.0 : sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace rakelight
