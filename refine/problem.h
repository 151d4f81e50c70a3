// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a stack to what a method works on: grid, start, observations, prior.
#pragma once

#include <string>

#include "refine/frame_thumbnails.h"
#include "refine/observations.h"
#include "refine/options.h"
#include "refine/steps/normals.h"
#include "refine/steps/preprocess.h"
#include "refine/steps/super_resolution.h"

namespace rakelight {

struct RefineProblem {
  std::string origin;  ///< folder of the stack, for messages
  int scale = 1;       ///< refined grid / depth grid
  SensorDepth sensor;  ///< preprocessed, on the depth grid
  PixelGrid grid;      ///< the refined grid
  CornerList corners;  ///< differences of the photometric term, cut at the start's depth jumps
  std::vector<unsigned char> cut_right,
      cut_down;  ///< [pixel] 1 where that step crosses a depth jump; empty in preset paper
  Observations images;
  std::vector<FrameThumbnail> thumbnails;  ///< of the first frames
  DepthPrior prior;  ///< cell_weight is relative: 1 where the sensor has a reading, 0 where z0 was filled in
  double depth_noise = 0;  ///< deviation of one depth reading in log depth
};

/// @throws InputError when the stack cannot be used, UsageError when options.scale is finer than the colour.
RefineProblem make_problem(const LightStack& stack, const RefineOptions& options);

}  // namespace rakelight
