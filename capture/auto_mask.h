// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The object in the picture: what the lamps light and what stands nearest to the middle in one piece of depth.
#pragma once

#include "capture/coarse_scene.h"

namespace rakelight {

/// Cells of the scene that are lit by some lamp and belong to the piece (no depth jump within) that holds most of the
/// image's middle; 255 or 0. @param light greatest light of any lamp at the cells, dark subtracted
cv::Mat1b object_cells(const CoarseScene& scene, const cv::Mat1f& light);

/// The mask of a finished stack on the depth grid, 255 = object: the same on full resolution. Empty if nothing is found.
cv::Mat1b auto_mask(const LightStack& stack);

}  // namespace rakelight
