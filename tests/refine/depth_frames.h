// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Depth recorded of planes.
#pragma once

#include <cmath>

#include "stack/stack.h"

namespace rakelight::test {

/// Cameras of 80 x 60 pixels that see the same view, no frames, no mask.
inline LightStack empty_stack() {
  LightStack stack;
  stack.color_camera = stack.depth_camera = {80, 60, 100.0, 100.0, 39.5, 29.5, {}};
  stack.depth_unit_m = 0.0001;
  return stack;
}

/// A depth frame whose reading at each pixel is depth_m(u, v).
template <class Depth>
Frame depth_frame(const LightStack& stack, const Depth& depth_m) {
  Frame frame;
  frame.depth = cv::Mat1w(stack.depth_camera.size());
  for (int v = 0; v < frame.depth.rows; ++v)
    for (int u = 0; u < frame.depth.cols; ++u)
      frame.depth(v, u) = static_cast<ushort>(std::lround(depth_m(u, v) / stack.depth_unit_m));
  return frame;
}

}  // namespace rakelight::test
