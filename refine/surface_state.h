// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a refinement knows at one moment: shape, albedo, lamps and how far each sample is trusted.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "refine/lamp.h"

namespace rakelight {

struct SurfaceState {
  Eigen::VectorXd zeta;      ///< [pixel] log depth
  Eigen::Matrix3Xf normals;  ///< [pixel] unit normals, camera frame
  Eigen::Matrix3Xf points;   ///< [pixel] metres, camera frame
  Eigen::Matrix3Xf albedo;   ///< [pixel] rho, a row a channel, mean 1 a channel
  std::vector<Lamp> lamps;   ///< [image]
  LampScene scene;
  bool attached_shadows = true;  ///< shading is max(0, l.n) + phi instead of l.n + phi
  int harmonics = 1;             ///< order of the far lamps' spherical harmonics, 1 or 2
  /// [image][pixel] trust in a sample, 0 to 1; 0 where it cannot be used. Empty: every sample that can be used counts fully.
  std::vector<float> weight;

  /// Trust in a sample that can be used.
  float trust(int image, int pixel) const {
    return weight.empty() ? 1.0f
                          : weight[static_cast<size_t>(image) * static_cast<size_t>(zeta.size()) +
                                   static_cast<size_t>(pixel)];
  }
};

/// Shading max(0, l.n) + phi (or l.n + phi) of each channel.
inline Eigen::Vector3f shading(const LocalLight& light, const Eigen::Vector3f& normal,
                               bool attached_shadows) {
  Eigen::Vector3f lit = light.l * normal;
  if (attached_shadows) lit = lit.cwiseMax(0.0f);
  return lit + light.phi;
}

}  // namespace rakelight
