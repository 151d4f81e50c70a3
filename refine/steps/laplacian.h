// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Differences that the smoothness terms |Lap z|^2 of Eq. (8) and of RGBD-Fusion are made of.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "refine/pixel_grid.h"

namespace rakelight {

/// Square matrix, a row a pixel: x_before - 2 x + x_after along one axis (kLeft, kRight or kUp, kDown). The row is empty
/// where one of the two is outside the mask or across a cut, so that neither border nor jump is pulled flat.
/// @param cuts 1 where the step to the neighbour `after` crosses a depth jump; may be empty.
Eigen::SparseMatrix<double> second_differences(const PixelGrid& grid, Neighbor before, Neighbor after,
                                               const std::vector<unsigned char>& cuts);

/// The plain graph Laplacian of the mask: every neighbour inside it counts, so its border is pulled flat (the paper).
Eigen::SparseMatrix<double> uncut_laplacian(const PixelGrid& grid);

}  // namespace rakelight
