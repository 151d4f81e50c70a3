// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Intrinsics of a camera, and the motion between two, from views of a ChArUco board (Zhang's method, OpenCV calib3d).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "capture/charuco.h"
#include "stack/stack.h"

namespace rakelight {

struct CameraFit {
  Camera camera;                    ///< with distortion k1 k2 p1 p2
  double rms_px = 0;                ///< reprojection error
  Eigen::Vector4d deviation_px;     ///< one standard deviation of fx, fy, cx, cy
  std::vector<std::string> views;   ///< names of the pictures used
  std::vector<double> view_rms_px;  ///< [view]
  double covered = 0;               ///< share of a 4 x 4 raster of the picture that has corners
};

/// @param views pictures of one camera; those with fewer than 8 corners are passed over
/// @throws InputError if fewer than 5 are left, their sizes differ, or they do not determine the camera
CameraFit calibrate_camera(const std::vector<BoardView>& views, const CharucoBoard& board);

struct PairFit {
  Eigen::Matrix4d T_color_depth;  ///< depth to colour coordinates, metres
  double rms_px = 0;              ///< reprojection error in both pictures
  int pairs = 0;
};

/// @param color, depth views of the same moments, in the same order
/// @throws InputError if fewer than 3 pairs show 8 corners in common
PairFit calibrate_pair(const std::vector<BoardView>& color, const Camera& color_camera,
                       const std::vector<BoardView>& depth, const Camera& depth_camera,
                       const CharucoBoard& board);

}  // namespace rakelight
