// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Laplacian of the smoothness terms |Lap z|^2 of Eq. (8) and of RGBD-Fusion, as printed.
#pragma once

#include <Eigen/SparseCore>

#include "refine/pixel_grid.h"

namespace rakelight {

/// The plain graph Laplacian of the mask: every neighbour inside it counts, so its border is pulled flat (the paper).
Eigen::SparseMatrix<double> uncut_laplacian(const PixelGrid& grid);

}  // namespace rakelight
