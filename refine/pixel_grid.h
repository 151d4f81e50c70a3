// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one place where images become vectors of unknowns: a number for each pixel of the mask.
#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

enum Neighbor { kRight = 0, kDown = 1, kLeft = 2, kUp = 3 };

/// Pixels of a row without a gap: first, first + 1, ... from column x on.
struct PixelRun {
  int first = 0, count = 0, x = 0;
};

/// Pixels of the mask in row-major order, with their neighbours inside the mask.
struct PixelGrid {
  Camera camera;
  cv::Mat1i index;                           ///< number of a pixel, -1 outside the mask
  std::vector<cv::Point> pixels;             ///< (u, v) of each number
  std::array<std::vector<int>, 4> neighbor;  ///< by Neighbor: number of the neighbour, -1 if outside

  cv::Rect box;                ///< bounds of the mask
  std::vector<PixelRun> runs;  ///< all pixels, row by row
  std::vector<int> first_run;  ///< [row of the box]: its first run; one more at the end

  int size() const { return static_cast<int>(pixels.size()); }
};

/// @param mask camera size, non-zero = surface.
PixelGrid make_pixel_grid(const Camera& camera, const cv::Mat1b& mask);

/// Values of an image at the grid's pixels.
Eigen::VectorXd gather(const PixelGrid& grid, const cv::Mat1f& image);

/// The opposite: an image with `outside` (NaN by default) where the grid has no pixel.
cv::Mat1f scatter(const PixelGrid& grid, const Eigen::VectorXd& values, float outside = NAN);

}  // namespace rakelight
