// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/objects/parametric_grid.h"

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace rakelight {
namespace {

std::size_t index_of(const GridShape& shape, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(shape.columns) +
         static_cast<std::size_t>(column);
}

/// Column before (step -1) or after (step 1), over the seam where there is one.
int column_beside(const GridShape& shape, int column, int step) {
  const int next = column + step;
  if (next >= 0 && next < shape.columns) return next;
  if (!shape.closed_columns) return column;
  return step < 0 ? shape.columns - 2 : 1;  // the first and the last column coincide
}

void sample(const GridShape& shape, const std::function<SurfacePoint(double, double)>& surface,
            SceneMesh& mesh) {
  cv::parallel_for_({0, shape.rows}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      for (int column = 0; column < shape.columns; ++column) {
        const auto point = surface(static_cast<double>(column) / (shape.columns - 1),
                                   static_cast<double>(row) / (shape.rows - 1));
        mesh.vertices[index_of(shape, column, row)] = point.position.cast<float>();
        mesh.texture[index_of(shape, column, row)] = point.texture.cast<float>();
      }
    }
  });
}

/// Normal by differences across the neighbours; a pole, where they vanish, takes it from the next row.
Eigen::Vector3f grid_normal(const GridShape& shape, const SceneMesh& mesh, int column, int row) {
  for (const int at : {row, row + 1 < shape.rows ? row + 1 : row - 1}) {
    const auto& left = mesh.vertices[index_of(shape, column_beside(shape, column, -1), at)];
    const auto& right = mesh.vertices[index_of(shape, column_beside(shape, column, 1), at)];
    const auto& above = mesh.vertices[index_of(shape, column, std::max(at - 1, 0))];
    const auto& below = mesh.vertices[index_of(shape, column, std::min(at + 1, shape.rows - 1))];
    const Eigen::Vector3d normal = (right - left).cast<double>().cross((below - above).cast<double>());
    const double scale =
        static_cast<double>((right - left).norm()) * static_cast<double>((below - above).norm());
    if (scale > 0 && normal.norm() > 1e-6 * scale) return normal.normalized().cast<float>();
  }
  return {0, 0, -1};
}

}  // namespace

SceneMesh parametric_grid(const GridShape& shape,
                          const std::function<SurfacePoint(double, double)>& surface) {
  SceneMesh mesh;
  const std::size_t count = static_cast<std::size_t>(shape.columns) * static_cast<std::size_t>(shape.rows);
  mesh.vertices.resize(count);
  mesh.texture.resize(count);
  mesh.normals.resize(count);
  sample(shape, surface, mesh);
  cv::parallel_for_({0, shape.rows}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) {
      for (int column = 0; column < shape.columns; ++column) {
        mesh.normals[index_of(shape, column, row)] = grid_normal(shape, mesh, column, row);
      }
    }
  });
  mesh.triangles.reserve(2 * count);
  for (int row = 0; row + 1 < shape.rows; ++row) {
    for (int column = 0; column + 1 < shape.columns; ++column) {
      const auto a = static_cast<std::uint32_t>(index_of(shape, column, row));
      const auto c = static_cast<std::uint32_t>(index_of(shape, column, row + 1));
      mesh.triangles.push_back({a, a + 1, c});
      mesh.triangles.push_back({a + 1, c + 1, c});
    }
  }
  return mesh;
}

void append(SceneMesh& mesh, const SceneMesh& other) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  mesh.normals.insert(mesh.normals.end(), other.normals.begin(), other.normals.end());
  mesh.texture.insert(mesh.texture.end(), other.texture.begin(), other.texture.end());
  mesh.triangles.reserve(mesh.triangles.size() + other.triangles.size());
  for (const auto& t : other.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

}  // namespace rakelight
