// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_unknowns.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "refine/steps/near_lamp_incidence.h"

namespace rakelight {

NearLampUnknowns NearLampUnknowns::moved(const Eigen::VectorXd& step, float max_inverse_distance) const {
  NearLampUnknowns result = *this;
  const Eigen::Vector3f aim = step.segment<kAim>(aim_at()).cast<float>();
  for (size_t i = 0; i < lamps.size(); ++i) {
    Lamp& lamp = result.lamps[i];
    if (!lamp.near) continue;
    const Eigen::Matrix<float, kLamp, 1> s =
        step.segment<kLamp>(lamp_at(static_cast<Eigen::Index>(i))).cast<float>();
    lamp.strength += s.segment<3>(3);
    lamp.phi += s.tail<3>();
    if (s.head<3>().isZero(0) && aim.isZero(0)) continue;  // a held place does not even drift by rounding
    const Eigen::Vector3f d = (lamp.direction + lamp_tangents(lamp.direction) * s.head<2>()).normalized();
    const float kappa = std::clamp(lamp.inverse_distance + s[2], 0.0f, max_inverse_distance);
    // Seen from the new aim: X - aim = d / kappa - (change of aim), times kappa
    const Eigen::Vector3f seen = d - kappa * aim;
    lamp.direction = seen.normalized();
    lamp.inverse_distance = std::min(kappa / seen.norm(), max_inverse_distance);
  }
  result.scene.center += aim;
  result.shape += step.segment<kShape>(shape_at());
  result.gloss = (gloss + step.segment<kGloss>(gloss_at())).cwiseMax(0.0);
  return result;
}

}  // namespace rakelight
