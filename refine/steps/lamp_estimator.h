// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which lamp model an image set gets, and its estimate at each outer iteration.
//
// The far model starts; a near model takes over once the shape has settled a little, because a real rig's lamps stand
// near and then the far model is simply wrong. The far model is a special case of the near one, so on far data the
// near model does no harm; it is kept only if it explains the images clearly better.
#pragma once

#include <optional>
#include <string>

#include "refine/options.h"
#include "refine/problem.h"
#include "refine/steps/near_lamps.h"
#include "refine/surface_state.h"

namespace rakelight {

class LampEstimator {
 public:
  explicit LampEstimator(const LampOptions& options);

  /// Estimates the state's lamps for outer iteration `iteration` (from 1), and its points where lamps are near or may turn
  /// out to be. Call it in order.
  /// @throws InputError when positions are to be taken from the stack and a lamp has none
  void update(const RefineProblem& problem, const DepthPrior& prior, SurfaceState& state, int iteration);

  /// Whether the last update moved the lamps too little to matter.
  bool settled() const { return settled_; }

  /// Each lamp's position, after the last update; empty where all lamps are far. A last fit on the finished
  /// surface, because the updates stop where the shape no longer gains.
  std::vector<LampUncertainty> positions(const RefineProblem& problem, const DepthPrior& prior,
                                         SurfaceState state) const;

  /// The images as the steps after the lamps should take them: without the highlights that the near lamps' fit has found.
  /// Changes with an update. The far model knows no highlights: as seen.
  const Observations& matt_images(const Observations& seen) const { return matt_ ? *matt_ : seen; }

  /// One sentence: the model used, and why.
  std::string explanation() const { return explanation_; }

  /// Residual scale of the far model over that of the near one, 0 if they were not compared.
  double far_over_near() const { return far_over_near_; }

 private:
  NearLampOptions fit_options() const;
  void start_near(const Observations& images, SurfaceState& state);
  void renew_matt_images(const Observations& seen, const SurfaceState& state);
  void choose(const Observations& images, SurfaceState& state);

  LampOptions options_;
  SurfaceState far_state_;              ///< what the far lamps had reached when near ones took over
  std::vector<RegionSamples> samples_;  ///< what near lamps are fitted to
  Gloss gloss_ = Gloss::Zero();
  std::optional<Observations> matt_;
  bool near_ = false;
  bool settled_ = true;
  double far_over_near_ = 0;
  std::string explanation_ = "far lamps: the near model was not tried";
};

}  // namespace rakelight
