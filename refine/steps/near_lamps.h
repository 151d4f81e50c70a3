// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Position and strength of lamps that stand near the object, from the images and the current shape and albedo
// (refine/lamp.h gives the model; metric depth fixes the scale). Nine unknowns a lamp: direction (2), inverse distance,
// strength (3) and ambient share (3); Levenberg-Marquardt on a subset of the pixels.
#pragma once

#include "refine/observations.h"
#include "refine/surface_state.h"

namespace rakelight {

struct NearLampOptions {
  int steps = 3;       ///< Levenberg-Marquardt steps a call
  int pixels = 12000;  ///< about so many pixels are used, evenly spread: nine unknowns need no more
  float max_inverse_distance = 10;  ///< 1/m: no lamp is taken to stand nearer than this to the centre
  bool fixed_positions = false;     ///< fit strength and ambient share only
};

/// What the fit knows of a lamp's position.
struct LampUncertainty {
  Eigen::Matrix3d position_covariance = Eigen::Matrix3d::Zero();  ///< m^2; meaningless for kappa near 0
  double distance_deviation = 0;                                  ///< m
  double direction_deviation = 0;                                 ///< rad
};

/// A near lamp started from a far one: its direction, its strength, and the given inverse distance.
Lamp near_from_far(const Lamp& far, float inverse_distance);

/// Improves the near lamps of the state in place of the far ones. @return one lamp an image.
std::vector<Lamp> estimate_near_lamps(const Observations& images, const SurfaceState& state,
                                      const NearLampOptions& options);

/// max(0, v.n) of the near model (refine/lamp.h) and its derivative by the lamp's direction along two tangents and by
/// kappa. A channel's shading is e_c value + phi_c.
struct Incidence {
  float value = 0;
  Eigen::Vector3f derivative = Eigen::Vector3f::Zero();
};

/// @param offset p - centre, metres  @param derivatives false: leave them zero
Incidence incidence_of(const Lamp& lamp, const Eigen::Matrix<float, 3, 2>& tangents,
                       const Eigen::Vector3f& offset, const Eigen::Vector3f& normal, float lobe_exponent,
                       bool derivatives = true);

/// Position uncertainty of each lamp from the curvature of its fit and the residuals. @param scale residual deviation
std::vector<LampUncertainty> near_lamp_uncertainty(const Observations& images, const SurfaceState& state,
                                                   const NearLampOptions& options);

/// Lamp position in camera coordinates, metres; at most 1 km away.
Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene);

}  // namespace rakelight
