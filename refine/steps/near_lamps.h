// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Position and strength of lamps that stand near the object, from the images and the depth (refine/lamp.h gives the
// model; metric depth fixes the scale).
//
// A lamp's distance trades against the albedo, the object's depth and the other lamps: each fitted alone, the others
// held, creeps for hundreds of iterations. So all are fitted at once, by Levenberg-Marquardt on
//
//     sum_pc sum_i w (I_ic - rho_c S_ic)^2 + lambda_z sum (zeta + B c - z0)^2
//
//   lamps   9 a lamp: direction (2), inverse distance, strength (3), ambient share (3)
//   aim     3: the point that the lamps' axes meet in
//   shape   7: B c, the broad changes of log depth 1, x, y, x^2, xy, y^2 and zeta, which span what light from unknown
//           directions leaves open (the bas-relief ambiguity)
//   albedo  3 a pixel, eliminated exactly: only what no albedo explains counts (variable projection; Kaufman's
//           Jacobian), a rank-one term a pixel and channel.
#pragma once

#include "refine/observations.h"
#include "refine/steps/super_resolution.h"
#include "refine/surface_state.h"

namespace rakelight {

struct NearLampOptions {
  int steps = 3;                    ///< Levenberg-Marquardt steps a call
  int pixels = 4000;                ///< about so many pixels are used, evenly spread
  float max_inverse_distance = 10;  ///< 1/m: no lamp is taken to stand nearer than this to the centre
  bool fixed_positions = false;     ///< fit strength and ambient share only
};

/// The surface that the lamps are fitted with, and what holds it.
struct BroadShape {
  const PixelGrid& grid;
  const DepthPrior& prior;
};

/// What the fit knows of a lamp's position.
struct LampUncertainty {
  Eigen::Matrix3d position_covariance = Eigen::Matrix3d::Zero();  ///< m^2; meaningless for kappa near 0
  double distance_deviation = 0;                                  ///< m
  double direction_deviation = 0;                                 ///< rad
};

/// A near lamp started from a far one: its direction, its strength, and the given inverse distance.
Lamp near_from_far(const Lamp& far, float inverse_distance);

/// Looks for each near lamp of the state all over the space before the object, given shape and albedo: a start that no
/// local minimum holds back. @return the state's lamps, the near ones where they explain their image best
std::vector<Lamp> search_near_lamps(const Observations& images, const SurfaceState& state);

/// Improves the state's near lamps and their aim (scene.center). Far lamps stay.
/// @param shape nullptr: the surface is held; else @return holds the change of zeta that goes with the lamps
Eigen::VectorXd fit_near_lamps(const Observations& images, const BroadShape* shape, const NearLampOptions& options,
                               SurfaceState& state);

/// max(0, v.n) of the near model (refine/lamp.h) and its derivatives. A channel's shading is e_c value + phi_c.
struct Incidence {
  float value = 0;
  Eigen::Vector3f lamp = Eigen::Vector3f::Zero();    ///< by the direction along two tangents and by kappa
  Eigen::Vector3f aim = Eigen::Vector3f::Zero();     ///< by the centre, the lamp's place held
  Eigen::Vector3f point = Eigen::Vector3f::Zero();   ///< by the surface point
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< by the normal
};

/// @param offset p - centre, metres  @param derivatives false: leave them zero
Incidence incidence_of(const Lamp& lamp, const Eigen::Matrix<float, 3, 2>& tangents, const Eigen::Vector3f& offset,
                       const Eigen::Vector3f& normal, float lobe_exponent, bool derivatives = true);

/// Position uncertainty of each lamp from the curvature of the joint fit and the residuals.
std::vector<LampUncertainty> near_lamp_uncertainty(const Observations& images, const BroadShape* shape,
                                                   const NearLampOptions& options, const SurfaceState& state);

/// Lamp position in camera coordinates, metres; at most 1 km away.
Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene);

}  // namespace rakelight
