// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_incidence.h"

#include <Eigen/Geometry>

namespace rakelight {

Eigen::Matrix<float, 3, 2> lamp_tangents(const Eigen::Vector3f& direction) {
  Eigen::Matrix<float, 3, 2> tangents;
  tangents.col(0) = direction.unitOrthogonal();
  tangents.col(1) = direction.cross(tangents.col(0));
  return tangents;
}

Incidence incidence_of(const Lamp& lamp, const Eigen::Matrix<float, 3, 2>& tangents,
                       const Eigen::Vector3f& offset, const Eigen::Vector3f& normal, float m,
                       bool derivatives) {
  const float kappa = lamp.inverse_distance;
  const Eigen::Vector3f &d = lamp.direction, u = d - kappa * offset;
  const float u2 = u.squaredNorm(), du = d.dot(u), un = u.dot(normal);
  if (un <= 0.0f || du <= 0.0f) return {};
  // v.n = (u.n) k with k = (d.u)^m |u|^-(3+m); change of u and d gives d(v.n) = k (du.n) + (u.n) dk.
  const float k = m == 1.0f ? du / (u2 * u2) : std::pow(du / std::sqrt(u2), m) / (u2 * std::sqrt(u2));
  Incidence result;
  result.value = un * k;
  if (!derivatives) return result;
  const Eigen::Vector3f by_u = k * normal + result.value * (m / du * d - (3 + m) / u2 * u);
  const Eigen::Vector3f by_d = by_u + result.value * m / du * u;
  result.lamp << tangents.transpose() * by_d, -offset.dot(by_u);
  result.aim = result.value * kappa * ((m - 2) * d - m / du * u);
  result.point = -kappa * by_u;
  result.normal = k * u;
  return result;
}

}  // namespace rakelight
