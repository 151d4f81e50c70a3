// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a near lamp of strength 1 sends to a surface point, and how that changes with each unknown of the joint lamp fit.
#pragma once

#include "refine/lamp.h"

namespace rakelight {

/// What incidence_of takes where no derivatives are asked for.
inline const Eigen::Matrix<float, 3, 2> kNoTangents = Eigen::Matrix<float, 3, 2>::Zero();

/// Two unit vectors that span the plane across the unit vector `direction`.
Eigen::Matrix<float, 3, 2> lamp_tangents(const Eigen::Vector3f& direction);

/// max(0, v.n) of the near model (refine/lamp.h) and its derivatives. A channel's shading is e_c value + phi_c.
struct Incidence {
  float value = 0;
  Eigen::Vector3f lamp = Eigen::Vector3f::Zero();    ///< by the direction along two tangents and by kappa
  Eigen::Vector3f aim = Eigen::Vector3f::Zero();     ///< by the centre, the lamp's place held
  Eigen::Vector3f point = Eigen::Vector3f::Zero();   ///< by the surface point
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< by the normal
};

/// @param tangents of lamp_tangents: what the derivatives by the direction go along; unused without derivatives
/// @param offset p - centre, metres  @param derivatives false: leave them zero
Incidence incidence_of(const Lamp& lamp, const Eigen::Matrix<float, 3, 2>& tangents,
                       const Eigen::Vector3f& offset, const Eigen::Vector3f& normal, float lobe_exponent,
                       bool derivatives = true);

}  // namespace rakelight
