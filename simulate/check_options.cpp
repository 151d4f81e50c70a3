// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/check_options.h"

#include <cmath>
#include <sstream>

#include "stack/errors.h"

namespace rakelight {
namespace {

/// NaN fails, too.
void require(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  std::ostringstream text;
  text << name << " is " << value << "; give a value from " << low << " to " << high;
  throw UsageError(text.str());
}

void check_lamps(const RigOptions& lamps) {
  require("number of lights", lamps.count, lamps.rgb ? 0 : 1, 999);
  require("lamp distance (m)", lamps.distance_m, 0.05, 100);
  require("spread of lamp distances", lamps.distance_spread, 0, 0.9);
  require("lamp angle (deg)", lamps.angle_deg, 1, 70);
  require("spread of lamp strengths", lamps.strength_spread, 0, 0.9);
  require("ambient light", lamps.ambient, 0, 10);
}

void check_image(const ImageOptions& image) {
  require("samples", image.samples, 1, 16);
  require("highlight", image.highlight, 0, 10);
  require("shininess", image.shininess, 1, 10000);
  require("shot noise", image.shot_noise, 0, 1);
  require("read noise", image.read_noise, 0, 1);
  require("clip share", image.clip_share, 0, 0.5);
  require("crosstalk", image.crosstalk, 0, 0.4);
  if (image.bits != 8 && image.bits != 16) throw UsageError("bits must be 8 or 16");
}

void check_depth(const DepthSensorOptions& depth) {
  require("depth frames", depth.frames, 0, 999);
  require("depth noise (mm)", depth.noise_mm, 0, 1000);
  require("white depth noise (mm)", depth.white_noise_mm, 0, 1000);
  require("depth noise correlation (px)", depth.correlation_px, 0.3, 100);
  require("drift of correlated depth noise", depth.correlated_drift, 0, 1);
  require("disparity step (px)", depth.disparity_step_px, 0, 4);
  require("baseline (m)", depth.baseline_m, 0.001, 10);
  require("depth unit (m)", depth.unit_m, 1e-6, 0.1);
}

}  // namespace

void check_options(const SimulateOptions& options) {
  require("depth grid width", options.width, 8, 4096);
  require("depth grid height", options.height, 8, 4096);
  require("colour scale", options.color_scale, 1, 4);
  require("threads", options.threads, 0, 4096);
  require("distance (m)", options.scene.distance_m, 0.1, 10);
  require("fill", options.scene.fill, 0.05, 2);
  for (int k = 0; k < 3; ++k) require("rotation (deg)", options.scene.rotation_deg[k], -360, 360);
  check_lamps(options.lamps);
  check_image(options.image);
  check_depth(options.depth);
}

}  // namespace rakelight
