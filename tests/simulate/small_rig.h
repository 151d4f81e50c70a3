// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scans that render in a blink.
#pragma once

#include "simulate/simulate.h"

namespace rakelight::test {

/// 64 x 48, one lamp, one depth frame, ideal images, exact depth.
inline SimulateOptions ideal_rig(SceneKind scene) {
  SimulateOptions options = realism_options(Realism::ideal);
  options.width = 64;
  options.height = 48;
  options.scene.kind = scene;
  options.lamps.count = 1;
  options.image.samples = 1;
  options.depth.frames = 1;
  options.depth.noise_mm = options.depth.white_noise_mm = options.depth.disparity_step_px = 0;
  options.depth.holes = false;
  return options;
}

/// 64 x 48, a vase, four lamps, everything that makes a scan real.
inline SimulateOptions real_rig() {
  SimulateOptions options = realism_options(Realism::real);
  options.width = 64;
  options.height = 48;
  options.lamps.count = 4;
  options.image.samples = 2;
  return options;
}

}  // namespace rakelight::test
