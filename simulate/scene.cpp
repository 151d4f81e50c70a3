// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "simulate/mesh_io.h"
#include "simulate/objects/objects.h"

namespace rakelight {
namespace {

Eigen::Matrix3f rotation(const Eigen::Vector3d& yaw_pitch_roll_deg) {
  const Eigen::Vector3d r = yaw_pitch_roll_deg * M_PI / 180;
  const Eigen::Quaterniond q = Eigen::AngleAxisd(r.x(), Eigen::Vector3d::UnitY()) *
                               Eigen::AngleAxisd(r.y(), Eigen::Vector3d::UnitX()) *
                               Eigen::AngleAxisd(r.z(), Eigen::Vector3d::UnitZ());
  return q.toRotationMatrix().cast<float>();
}

void rotate(SceneMesh& mesh, const Eigen::Matrix3f& matrix) {
  for (auto& v : mesh.vertices) v = matrix * v;
  for (auto& n : mesh.normals) n = matrix * n;
}

void center_on_origin(SceneMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const auto& v : mesh.vertices) box.extend(v);
  for (auto& v : mesh.vertices) v -= box.center();
}

/// Largest scale s at which every vertex s p + (0, 0, distance) projects into the central `fill` of the view and
/// stays beyond a fifth of the distance: f s |x| <= m (D + s z) bounds s by m D / (f |x| - m z).
double fitting_scale(const SceneMesh& mesh, const SceneOptions& options, const Camera& camera) {
  const double half_width = options.fill * camera.width / 2, half_height = options.fill * camera.height / 2;
  double scale = std::numeric_limits<double>::max();
  const auto bound = [&scale](double limit, double slope) {
    if (slope > 0) scale = std::min(scale, limit / slope);
  };
  for (const auto& vertex : mesh.vertices) {
    const Eigen::Vector3d p = vertex.cast<double>();
    bound(half_width * options.distance_m, camera.fx * std::abs(p.x()) - half_width * p.z());
    bound(half_height * options.distance_m, camera.fy * std::abs(p.y()) - half_height * p.z());
    bound(0.8 * options.distance_m, -p.z());
  }
  return scale;
}

/// The turn each procedural scene is best seen at: yaw, pitch, roll in degrees.
Eigen::Vector3d own_rotation_deg(SceneKind kind) {
  switch (kind) {
    case SceneKind::vase:
      return {0, -8, 0};
    case SceneKind::coin:
      return {14, 10, 0};
    case SceneKind::plane:
      return {25, 15, 0};
    default:
      return {0, 0, 0};
  }
}

SceneMesh object_mesh(const SceneOptions& options, int detail) {
  switch (options.kind) {
    case SceneKind::vase:
      return make_vase(detail);
    case SceneKind::coin:
      return make_coin(detail);
    case SceneKind::drape:
      return make_drape(detail);
    case SceneKind::sphere:
      return make_sphere(detail);
    case SceneKind::plane:
      return make_plane();
    case SceneKind::mesh:
      break;
  }
  return read_mesh(options.mesh);
}

}  // namespace

void place(SceneMesh& mesh, const SceneOptions& options, const Camera& camera) {
  rotate(mesh, rotation(options.rotation_deg) * rotation(own_rotation_deg(options.kind)));
  center_on_origin(mesh);
  const auto scale = static_cast<float>(fitting_scale(mesh, options, camera));
  const Eigen::Vector3f center(0, 0, static_cast<float>(options.distance_m));
  for (auto& v : mesh.vertices) v = scale * v + center;
}

SceneMesh make_scene(const SceneOptions& options, const Camera& camera) {
  // Facets of about half a pixel; beyond 700 pixels smooth normals carry the rest.
  constexpr int kMaxDetail = 700;
  SceneMesh mesh = object_mesh(options, std::min(camera.height, kMaxDetail));
  place(mesh, options, camera);
  return mesh;
}

}  // namespace rakelight
