// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smoothness term |Lap z|^2 of Eq. (8) and of RGBD-Fusion, optionally cut at depth jumps.
#pragma once

#include <Eigen/SparseCore>

#include "refine/pixel_grid.h"

namespace rakelight {

/// Square matrix, a row a pixel: second differences along x and y, added. An axis is left out where one of its two
/// neighbours is outside the mask or across a cut, so that neither border nor jump is pulled flat.
/// @param cut_right, cut_down  1 where the step to that neighbour crosses a depth jump; may be empty.
Eigen::SparseMatrix<double> laplacian(const PixelGrid& grid, const std::vector<unsigned char>& cut_right = {},
                                      const std::vector<unsigned char>& cut_down = {});

/// The plain graph Laplacian of the mask: every neighbour inside it counts, so its border is pulled flat (the paper).
Eigen::SparseMatrix<double> uncut_laplacian(const PixelGrid& grid);

}  // namespace rakelight
