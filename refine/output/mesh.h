// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The refined surface as triangles.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "refine/refine.h"

namespace rakelight {

struct MeshVertex {
  cv::Vec3f position;  ///< camera coordinates, metres
  cv::Vec3f normal;    ///< camera coordinates, unit length, towards the camera
  cv::Vec3b color;     ///< albedo as sRGB, R G B
  float delta_mm = 0;  ///< refined minus sensor depth; NaN where the sensor's is not known
};

struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from the camera
};

/// One vertex a pixel with depth, row by row; neighbours are joined unless a depth jump lies between them.
/// @param stride takes every stride-th pixel of every stride-th row
Mesh mesh_of(const RefineResult& result, int stride = 1);

/// The smallest stride that leaves about `vertices` vertices or fewer.
int stride_for(const cv::Mat1f& depth, int vertices);

}  // namespace rakelight
