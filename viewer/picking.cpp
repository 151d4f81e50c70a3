// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/picking.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rakelight {
namespace {

Eigen::Vector3d eigen(const cv::Vec3f& v) { return Eigen::Vector3f(v.val).cast<double>(); }

struct Hit {
  double distance = std::numeric_limits<double>::infinity();
  std::array<double, 3> weights{};  ///< barycentric
};

/// Moeller and Trumbore, Fast minimum storage ray-triangle intersection, 1997.
std::optional<Hit> intersect(const Ray& ray, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return std::nullopt;
  const Eigen::Vector3d from = ray.origin - a, q = from.cross(ab);
  const double u = from.dot(p) / determinant, v = ray.direction.dot(q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  const double distance = ac.dot(q) / determinant;
  if (distance <= 0) return std::nullopt;
  return Hit{distance, {1 - u - v, u, v}};
}

}  // namespace

std::optional<Picked> pick(const Surface& surface, const Ray& ray) {
  Hit nearest;
  const std::array<int, 3>* triangle = nullptr;
  const auto corner = [&surface](int index) {
    return eigen(surface.positions[static_cast<std::size_t>(index)]);
  };
  for (const std::array<int, 3>& candidate : surface.triangles) {
    const auto hit = intersect(ray, corner(candidate[0]), corner(candidate[1]), corner(candidate[2]));
    if (!hit || hit->distance >= nearest.distance) continue;
    nearest = *hit;
    triangle = &candidate;
  }
  if (triangle == nullptr) return std::nullopt;
  const auto largest =
      std::max_element(nearest.weights.begin(), nearest.weights.end()) - nearest.weights.begin();
  const int vertex = (*triangle)[static_cast<std::size_t>(largest)];
  return Picked{ray.origin + nearest.distance * ray.direction,
                surface.pixels[static_cast<std::size_t>(vertex)]};
}

}  // namespace rakelight
