// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rays against the scene. Embree stays behind this header.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "simulate/mesh.h"

namespace rakelight {

/// Where a ray met the surface, in camera coordinates; normals point to the side the ray came from.
struct SurfaceHit {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;  ///< smooth, unit length
  Eigen::Vector3f facet;   ///< of the triangle itself, unit length
  Eigen::Vector2f texture;
};

/// From a hit to a point `distance` metres along a unit direction.
struct ShadowRay {
  const SurfaceHit* from;
  Eigen::Vector3f direction;
  float distance;
};

class RayTracer {
 public:
  /// @throws std::runtime_error when Embree cannot build the scene.
  explicit RayTracer(SceneMesh mesh);
  ~RayTracer();
  RayTracer(const RayTracer&) = delete;
  RayTracer& operator=(const RayTracer&) = delete;

  /// First surface along a ray (direction need not be of unit length). Thread-safe.
  std::optional<SurfaceHit> trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;

  /// Which of the ways from hits to lamps the scene blocks. Rays of neighbouring hits are fastest. Thread-safe.
  void find_occluded(const std::vector<ShadowRay>& rays, std::vector<bool>& occluded) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace rakelight
