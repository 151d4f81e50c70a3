// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small result with everything in it that an output must carry.
#pragma once

#include <limits>

#include "refine/refine.h"

namespace rakelight::test {

/// Columns left of kSampleJump lie at about 0.5 m, the others 0.2 m deeper; a border of one pixel has no surface.
inline constexpr int kSampleWidth = 24, kSampleHeight = 16, kSampleJump = 12;

inline RefineResult sample_result() {
  const cv::Size size(kSampleWidth, kSampleHeight);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  RefineResult result;
  result.camera = {size.width, size.height, 570.0, 572.0, 11.5, 7.5, {}};
  result.depth = cv::Mat1f(size, nan);
  result.initial_depth = cv::Mat1f(size, nan);
  result.normals = cv::Mat3f(size, cv::Vec3f::all(nan));
  result.albedo = cv::Mat3f(size, cv::Vec3f::all(nan));
  result.inpainted = cv::Mat1b(size, uchar{0});
  for (int y = 1; y + 1 < size.height; ++y) {
    for (int x = 1; x + 1 < size.width; ++x) {
      const float column = static_cast<float>(x), row = static_cast<float>(y);
      result.depth(y, x) = 0.5f + 0.0001f * column + (x < kSampleJump ? 0.0f : 0.2f);
      result.initial_depth(y, x) = result.depth(y, x) - 0.001f;
      result.normals(y, x) = cv::normalize(cv::Vec3f(0.1f, -0.2f, -1.0f));
      result.albedo(y, x) = {0.5f + column / 24, 1.0f, 1.5f - row / 16};
    }
  }
  LightEstimate light;
  light.id = "lamp \"7\"";
  light.frame_index = 3;
  light.sh_rgb << 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2;
  result.lights.push_back(light);
  IterationReport iteration;
  iteration.index = 1;
  iteration.energy = 0.25;
  iteration.seconds = 0.125;
  result.iterations.push_back(iteration);
  result.termination = Termination::converged;
  result.message = "The depth no longer changed.";
  result.warnings.push_back("A tenth of the object is saturated.");
  result.quality["coverage"] = 0.9;
  return result;
}

}  // namespace rakelight::test
