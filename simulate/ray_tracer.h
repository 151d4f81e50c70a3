// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rays against the scene. Embree stays behind this header.
#pragma once

#include <memory>
#include <optional>

#include "simulate/mesh.h"

namespace rakelight {

/// Where a ray met the surface, in camera coordinates; normals point to the side the ray came from.
struct SurfaceHit {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;  ///< smooth, unit length
  Eigen::Vector3f facet;   ///< of the triangle itself, unit length
  Eigen::Vector2f texture;
};

class RayTracer {
 public:
  /// @throws std::runtime_error when Embree cannot build the scene.
  explicit RayTracer(Mesh mesh);
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  /// First surface along a ray (direction need not be of unit length). Thread-safe.
  std::optional<SurfaceHit> trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  /// Does the scene block the way from a hit to a point `distance` metres along a unit direction? Thread-safe.
  bool occluded(const SurfaceHit& from, const Eigen::Vector3f& direction, float distance) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace rakelight
