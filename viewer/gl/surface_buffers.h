// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface in the graphics card's memory.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "viewer/gl/gl_object.h"
#include "viewer/surface.h"

namespace rakelight {

class SurfaceBuffers {
 public:
  explicit SurfaceBuffers(const Surface& surface);
  /// @param colors sRGB, one a point
  void set_colors(const std::vector<cv::Vec3b>& colors);
  void draw_points() const;
  void draw_mesh() const;
  /// Fewer triangles, for a picture that is soon followed by another.
  void draw_coarse_mesh() const;

 private:
  GlObject array_, positions_, normals_, colors_, indices_, coarse_indices_;
  int points_ = 0, indices_count_ = 0, coarse_indices_count_ = 0;
};

}  // namespace rakelight
