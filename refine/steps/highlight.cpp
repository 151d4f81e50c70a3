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
  for (size_t j = 0; j < kLobeExponents.size(); ++j)
    lobes[static_cast<Eigen::Index>(j)] = static_cast<double>(v.norm() * std::pow(cosine, kLobeExponents[j]));
  return lobes;
}

}  // namespace rakelight
