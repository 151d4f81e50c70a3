// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/stack.h"

#include <cmath>

#include "stack/parallel.h"

namespace rakelight {

std::string to_string(LampColor color) {
  switch (color) {
    case LampColor::red:
      return "red";
    case LampColor::green:
      return "green";
    case LampColor::blue:
      return "blue";
    case LampColor::white:
      return "white";
    case LampColor::rgb:
      return "rgb";
  }
  return "white";
}

bool has_color(const Frame& frame) { return !frame.color.empty() || frame.read_color; }

Frame with_color(const Frame& frame) {
  Frame whole = frame;
  if (whole.color.empty() && whole.read_color) whole.color = whole.read_color();
  whole.read_color = nullptr;
  return whole;
}

LightStack in_memory(LightStack stack) {
  in_parallel(static_cast<int>(stack.frames.size()), [&](int k) {
    Frame& frame = stack.frames[static_cast<std::size_t>(k)];
    frame = with_color(frame);
  });
  return stack;
}

Camera binned(const Camera& camera, double factor) {
  Camera result = camera;
  result.width = static_cast<int>(std::lround(camera.width / factor));
  result.height = static_cast<int>(std::lround(camera.height / factor));
  result.fx = camera.fx / factor;
  result.fy = camera.fy / factor;
  result.cx = (camera.cx + 0.5) / factor - 0.5;
  result.cy = (camera.cy + 0.5) / factor - 0.5;
  return result;
}

}  // namespace rakelight
