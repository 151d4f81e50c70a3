// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "refine/lamp.h"
#include "refine/steps/broad_shape.h"
#include "refine/steps/highlight.h"

namespace rakelight {

/// What the joint lamp fit moves. Order of the unknowns: 9 a lamp (direction along its two tangents, inverse distance,
/// strength (3), ambient share (3)), then the aim (3), the broad shape (7) and the gloss (2).
struct NearLampUnknowns {
  static constexpr int kLamp = 9, kAim = 3, kShape = kBroadChanges, kGloss = kHighlightLobes,
                       kShared = kAim + kShape + kGloss;

  std::vector<Lamp> lamps;
  LampScene scene;  ///< its centre is the aim
  Gloss gloss = Gloss::Zero();
  Eigen::Matrix<double, kShape, 1> shape = Eigen::Matrix<double, kShape, 1>::Zero();

  Eigen::Index lamp_at(Eigen::Index image) const { return kLamp * image; }
  Eigen::Index aim_at() const { return kLamp * static_cast<Eigen::Index>(lamps.size()); }
  Eigen::Index shape_at() const { return aim_at() + kAim; }
  Eigen::Index gloss_at() const { return shape_at() + kShape; }
  Eigen::Index size() const { return aim_at() + kShared; }

  /// After the step; what each lamp's place is does not depend on the change of aim.
  NearLampUnknowns moved(const Eigen::VectorXd& step, float max_inverse_distance) const;
};

}  // namespace rakelight
