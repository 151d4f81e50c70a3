// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of a ChArUco board by a camera that is known exactly.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "capture/charuco.h"
#include "stack/stack.h"

namespace rakelight::test {

/// From board coordinates (origin at the board's centre, x right and y down as printed, metres) to camera coordinates.
using BoardPose = Eigen::Isometry3d;

/// Fourteen poses about 0.45 m from the camera, tilted every way, that reach the picture's corners.
std::vector<BoardPose> varied_poses();

/// Lens distortion included; 2 x 2 samples a pixel; no noise.
cv::Mat1b render_board(const CharucoBoard& board, const BoardPose& T_camera_board, const Camera& camera);

}  // namespace rakelight::test
