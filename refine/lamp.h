// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a lamp lights a surface point. Two models, one local form that every step uses:
//
//     far:   S_c = max(0, l_c . n) + phi_c                            first-order harmonics, Eq. (3)
//            S_c = l_c . n + phi_c + n' Q_c n                         second-order, Q symmetric with trace 0
//     near:  S_c = e_c max(0, v . n) + phi_c                          a point source with an emission lobe
//            v = u (d.u)^m / |u|^(3+m),   u = d - kappa (p - centre)
//
// The lamp stands at X = centre + d / kappa with its axis towards the object's centre. This is the usual
// e (X - p) R^2 cos^m / |X - p|^3 with R = 1 / kappa divided out, so e is the strength at the centre and kappa -> 0 is
// the far lamp of direction d, without a singularity.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "refine/pixel_grid.h"

namespace rakelight {

/// Light of one image; matrices have a row a channel (R, G, B).
struct Lamp {
  bool near = false;
  Eigen::Vector3f phi = Eigen::Vector3f::Zero();  ///< ambient share a channel
  Eigen::Matrix3f l = Eigen::Matrix3f::Zero();    ///< far: light vector a channel
  bool second_order = false;                      ///< far: whether Q counts
  std::array<Eigen::Matrix3f, 3> Q{Eigen::Matrix3f::Zero(), Eigen::Matrix3f::Zero(),
                                   Eigen::Matrix3f::Zero()};  ///< far: second-order harmonics a channel
  Eigen::Vector3f direction = Eigen::Vector3f(0, 0, -1);      ///< near: d, unit, from the object to the lamp
  float inverse_distance = 0;                                 ///< near: kappa, 1/m
  Eigen::Vector3f strength = Eigen::Vector3f::Zero();         ///< near: e a channel
};

/// Light at one point: S_c = max(0, l.row(c) . n) + phi_c.
struct LocalLight {
  Eigen::Matrix3f l;
  Eigen::Vector3f phi;
};

/// What a near lamp needs to know of the object.
struct LampScene {
  Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< of the surface points, metres
  float lobe_exponent = 1.0f;                        ///< m above: 0 isotropic, 1 Lambertian LED
};

/// v above: irradiance vector of a near lamp of unit strength, at offset = p - centre (metres).
inline Eigen::Vector3f near_light_vector(const Eigen::Vector3f& direction, float inverse_distance,
                                         const Eigen::Vector3f& offset, float lobe_exponent) {
  const Eigen::Vector3f u = direction - inverse_distance * offset;
  const float u2 = u.squaredNorm();
  const float cosine = std::max(0.0f, direction.dot(u)) / std::sqrt(u2);
  const float lobe = lobe_exponent == 1.0f ? cosine : std::pow(cosine, lobe_exponent);
  return u * (lobe / (u2 * std::sqrt(u2)));
}

/// Light of a lamp at point p (metres, camera frame), first order.
inline LocalLight light_at(const Lamp& lamp, const Eigen::Vector3f& p, const LampScene& scene) {
  if (!lamp.near) return {lamp.l, lamp.phi};
  const Eigen::Vector3f v =
      near_light_vector(lamp.direction, lamp.inverse_distance, p - scene.center, scene.lobe_exponent);
  return {lamp.strength * v.transpose(), lamp.phi};
}

/// Light of a lamp at point p, linear in the normal and exact at n: l + 2 Q n, phi - n' Q n.
inline LocalLight light_at(const Lamp& lamp, const Eigen::Vector3f& p, const Eigen::Vector3f& n,
                           const LampScene& scene) {
  LocalLight light = light_at(lamp, p, scene);
  if (!lamp.second_order) return light;
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3f Qn = lamp.Q[static_cast<size_t>(c)] * n;
    light.l.row(c) += 2.0f * Qn.transpose();
    light.phi[c] -= n.dot(Qn);
  }
  return light;
}

/// Surface points (3 x pixels, metres, camera frame) of zeta = log z.
Eigen::Matrix3Xf surface_points(const PixelGrid& grid, const Eigen::VectorXd& zeta);

}  // namespace rakelight
