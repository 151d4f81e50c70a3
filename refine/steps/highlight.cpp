// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/highlight.h"

namespace rakelight {

Eigen::Matrix<double, kHighlightLobes, 1> highlight_lobes(const Lamp& lamp, const Eigen::Vector3f& p,
                                                          const Eigen::Vector3f& n, const LampScene& scene) {
  Eigen::Matrix<double, kHighlightLobes, 1> lobes = Eigen::Matrix<double, kHighlightLobes, 1>::Zero();
  if (!lamp.near) return lobes;
  const Eigen::Vector3f v =
      near_light_vector(lamp.direction, lamp.inverse_distance, p - scene.center, scene.lobe_exponent);
  if (v.dot(n) <= 0) return lobes;
  const float cosine = std::max(0.0f, n.dot((v.normalized() - p.normalized()).normalized()));
  const auto fourth = [](float x) { return x * x * x * x; };
  const float broad = fourth(fourth(cosine)), sharp = fourth(broad);
  static_assert(kLobeExponents[0] == 16 && kLobeExponents[1] == 64);
  lobes << static_cast<double>(v.norm() * broad), static_cast<double>(v.norm() * sharp);
  return lobes;
}

}  // namespace rakelight
