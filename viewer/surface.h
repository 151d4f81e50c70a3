// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A depth map as points and triangles, ready to be drawn and picked.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "viewer/scene.h"

namespace rakelight {

struct Box {
  cv::Vec3d low, high;  ///< metres, camera coordinates
  cv::Vec3d center() const { return 0.5 * (low + high); }
  double diagonal() const { return cv::norm(high - low); }
};

struct Surface {
  std::vector<cv::Vec3f> positions;  ///< camera coordinates, metres; one a pixel with depth, row by row
  std::vector<cv::Vec3f> normals;    ///< camera frame, unit length
  std::vector<cv::Point> pixels;     ///< where each point lies on the layer's grid
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from the camera, cut at depth jumps
  /// Every second, third ... row and column, for pictures that are soon followed by another; empty if there are few.
  std::vector<std::array<int, 3>> coarse_triangles;
  Box bounds;  ///< of all but the outermost points: a stray reading does not shrink the object to a dot
};

/// @throws InputError if the layer has no point, or more than can be drawn (kMostPoints)
Surface surface_of(const Layer& layer, const std::string& subject);

/// Above this, a graphics card's memory and a person's patience end.
inline constexpr std::size_t kMostPoints = 12'000'000;

/// A surface of more points has coarse triangles, between about so many.
inline constexpr int kCoarsePoints = 80'000;

/// @throws InputError as surface_of
void check_point_count(std::size_t points, const std::string& subject);

}  // namespace rakelight
