// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/lamp_shading.h"

#include <limits>

namespace rakelight {
namespace {

/// v . n of a near lamp (refine/lamp.h); kLambertian: the lobe exponent is 1, which needs no root.
template <bool kLambertian>
void near_incidence(const Lamp& lamp, const SurfaceState& state, int begin, int end, float* incidence) {
  const Eigen::Vector3f d = lamp.direction, center = state.scene.center;
  const float kappa = lamp.inverse_distance, m = state.scene.lobe_exponent;
  for (int p = begin; p < end; ++p) {
    const Eigen::Vector3f u = d - kappa * (state.points.col(p) - center);
    const float u2 = u.squaredNorm(), du = std::max(0.0f, d.dot(u));
    const float lobe = kLambertian ? du : std::pow(du / std::sqrt(u2), m) * std::sqrt(u2);
    incidence[p - begin] = u.dot(state.normals.col(p)) * lobe / (u2 * u2);
  }
}

void add_second_order(const Eigen::Matrix3f& Q, const SurfaceState& state, int begin, int end, float* S) {
  for (int p = begin; p < end; ++p) {
    const auto n = state.normals.col(p);
    S[p - begin] += n.dot(Q * n);
  }
}

}  // namespace

void shade(const Lamp& lamp, const SurfaceState& state, int begin, int end, ShadingBlock& block) {
  const int count = end - begin;
  const float least = state.attached_shadows ? 0.0f : -std::numeric_limits<float>::infinity();
  if (!lamp.near) {
    for (int c = 0; c < 3; ++c) {
      const Eigen::Vector3f l = lamp.l.row(c).transpose();
      float* S = block.S[static_cast<size_t>(c)].data();
      for (int k = 0; k < count; ++k)
        S[k] = std::max(least, l.dot(state.normals.col(begin + k))) + lamp.phi[c];
      if (lamp.second_order) add_second_order(lamp.Q[static_cast<size_t>(c)], state, begin, end, S);
    }
    return;
  }
  std::array<float, kPixelBlock> incidence;
  if (state.scene.lobe_exponent == 1.0f)
    near_incidence<true>(lamp, state, begin, end, incidence.data());
  else
    near_incidence<false>(lamp, state, begin, end, incidence.data());
  for (int c = 0; c < 3; ++c) {
    float* S = block.S[static_cast<size_t>(c)].data();
    for (int k = 0; k < count; ++k)
      S[k] = std::max(least, lamp.strength[c] * incidence[static_cast<size_t>(k)]) + lamp.phi[c];
  }
}

}  // namespace rakelight
