// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far images and depth miss the model, measured, so that lambda_z need not be guessed.
//
// One constant cannot serve: 100 suits a head at 1 m and 3 mm noise, 1e4 a bear at 1.5 m and 0.7 mm. Statistics asks for the
// ratio of the two error variances. Both errors are correlated over neighbouring pixels (model error there, the sensor's
// block matching here), and only what survives averaging matters for the shape's broad form; so both are measured as means
// over blocks, scaled by the square root of the block's size: for white noise that is the deviation of one sample. Multi-light takes the images'
// error from its residual scale instead (refine/steps/robust_weights.h): a shape that is tied to the sensor misses the
// images broadly, and measured over blocks that would tie it all the more.
#pragma once

#include "refine/observations.h"
#include "refine/steps/super_resolution.h"
#include "refine/surface_state.h"

namespace rakelight {

struct MeasuredNoise {
  double image = 0;  ///< deviation of a radiance sample, white equivalent on block scale
  double depth = 0;  ///< deviation of a log-depth reading, white equivalent on block scale
};

/// Robust (median based) over blocks of kNoiseBlock x kNoiseBlock depth pixels.
/// Image: residuals weighted by trust, summed over channels (a wrong normal or lamp errs in all three alike).
/// Depth: reading minus refined depth, differences of neighbouring blocks, so that the refined shape's own broad
/// error does not count as the sensor's.
/// @param scale refined grid / depth grid
MeasuredNoise measure_noise(const PixelGrid& grid, const Observations& images, const SurfaceState& state,
                            const DepthPrior& prior, int scale);

/// The depth's alone: deviation of a log-depth reading; 0 when no block has enough readings. An offset of the refined
/// shape does not count as the sensor's error; a tilt does, a little.
double measure_sensor_noise(const PixelGrid& grid, const SurfaceState& state, const DepthPrior& prior,
                            int scale);

}  // namespace rakelight
