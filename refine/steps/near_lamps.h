// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Position and strength of lamps that stand near the object, from the images and the depth (refine/lamp.h gives the
// model; metric depth fixes the scale).
//
// A lamp's distance trades against the albedo, the object's depth and the other lamps: each fitted alone, the others
// held, creeps for hundreds of iterations. So all are fitted at once, by Levenberg-Marquardt on
//
//     sum_pc sum_i w (I_ic - rho_c S_ic - H_ic)^2 + lambda_z sum (zeta + B c - z0)^2
//
//   lamps   9 a lamp: direction (2), inverse distance, strength (3), ambient share (3)
//   aim     3: the point that the lamps' axes meet in
//   shape   7: B c, the broad changes of log depth (refine/steps/broad_shape.h)
//   gloss   2: highlights H (refine/steps/highlight.h); their place is taken up anew at each call
//   albedo  3 a pixel, eliminated exactly: only what no albedo explains counts (variable projection; Kaufman's
//           Jacobian), a rank-one term a pixel and channel.
#pragma once

#include "refine/steps/broad_shape.h"
#include "refine/steps/highlight.h"
#include "refine/steps/near_lamp_samples.h"
#include "refine/surface_state.h"

namespace rakelight {

struct NearLampOptions {
  int steps = 3;                    ///< Levenberg-Marquardt steps a call
  bool highlights = false;          ///< fit the gloss too, and forget shadows (near_lamp_shadows.h)
  float max_inverse_distance = 10;  ///< 1/m: no lamp is taken to stand nearer than this to the centre
  bool fixed_positions = false;     ///< fit strength and ambient share only
};

/// What the fit knows of a lamp's position.
struct LampUncertainty {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();             ///< camera coordinates, metres
  Eigen::Matrix3d position_covariance = Eigen::Matrix3d::Zero();  ///< m^2; meaningless for kappa near 0
  double distance_deviation = 0;                                  ///< m
  double direction_deviation = 0;                                 ///< rad
};

/// A near lamp started from a far one: its direction, its strength, and the given inverse distance.
Lamp near_from_far(const Lamp& far, float inverse_distance);

/// Improves the state's near lamps and their aim (scene.center). Far lamps stay. Strength is found up to one factor a
/// channel, the same for all lamps: the albedo takes the rest. The gloss is improved with them.
/// @param shape nullptr: the surface is held; else @return holds the change of zeta that goes with the lamps
Eigen::VectorXd fit_near_lamps(const std::vector<RegionSamples>& samples, const BroadShape* shape,
                               const NearLampOptions& options, SurfaceState& state, Gloss& gloss);

/// Position uncertainty of each lamp, the state being fitted: a jackknife over regions of the picture. Errors of the
/// model (highlights, shadows, the sensor's depth) agree between neighbouring pixels and between images, so residuals
/// taken as independent promise far too much; how the fit changes when a region is left out shows what they do to it. One
/// Gauss-Newton step stands for each refit. Errors that the whole picture shares do not show.
std::vector<LampUncertainty> near_lamp_uncertainty(const std::vector<RegionSamples>& samples,
                                                   const BroadShape* shape, const NearLampOptions& options,
                                                   const SurfaceState& state, const Gloss& gloss);

/// Lamp position in camera coordinates, metres; at most 1 km away.
Eigen::Vector3d lamp_position(const Lamp& lamp, const LampScene& scene);

}  // namespace rakelight
