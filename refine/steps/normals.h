// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Eq. (5): the normal of a surface given by zeta = log z under perspective projection.
//
//     n = J' / d,  J' = (fx zeta_x, fy zeta_y, -1 - x~ zeta_x - y~ zeta_y),  d = |J'|,   n_z < 0 faces the camera
//
// zeta_x and zeta_y come from one neighbour to the left or right and one above or below: a corner of the pixel.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "refine/options.h"
#include "refine/pixel_grid.h"

namespace rakelight {

/// One way to take the two differences at a pixel: signs tell forward (+1) from backward (-1).
struct Corner {
  int x_neighbor, y_neighbor;
  float x_sign, y_sign;
};

/// The corners of a pixel: right-down, left-down, right-up, left-up.
constexpr int kCorners = 4;

/// Corner k of pixel p, whose neighbours are in the mask.
Corner corner_at(const PixelGrid& grid, int p, int k);

/// Corners of each pixel that lie in the mask and do not cross a cut. A pixel that has corners across cuts only keeps those,
/// with weight 0: a rough normal, no say in the shape.
struct CornerList {
  std::vector<unsigned char> present;  ///< [pixel]: bit k for corner k; padded by kVectorPadding
  std::vector<float>
      weight;  ///< [pixel]: of each corner, 1 / number of corners of the pixel; padded likewise

  bool has(int p, int k) const { return (present[static_cast<size_t>(p)] >> k & 1) != 0; }

  /// Number of the first corner, -1 without any.
  int first(int p) const;
};

/// @param cut_right, cut_down  1 where the step to that neighbour crosses a depth jump; may be empty.
CornerList make_corners(const PixelGrid& grid, Stencil stencil,
                        const std::vector<unsigned char>& cut_right = {},
                        const std::vector<unsigned char>& cut_down = {});

/// Unnormalised normal of Eq. (5) and its derivative by the gradient (zeta_x, zeta_y).
struct NormalFrame {
  float fx, fy, x, y;  ///< x~ = u - cx, y~ = v - cy
  Eigen::Vector3f raw(float zx, float zy) const { return {fx * zx, fy * zy, -1.0f - x * zx - y * zy}; }
  /// J = d raw / d (zeta_x, zeta_y)
  Eigen::Matrix<float, 3, 2> jacobian() const {
    Eigen::Matrix<float, 3, 2> J;
    J << fx, 0, 0, fy, -x, -y;
    return J;
  }
};

NormalFrame normal_frame(const PixelGrid& grid, int p);

/// Gradient of zeta at corner k of pixel p.
inline Eigen::Vector2f corner_gradient(const Corner& corner, int p, const Eigen::VectorXd& zeta) {
  return {corner.x_sign * static_cast<float>(zeta[corner.x_neighbor] - zeta[p]),
          corner.y_sign * static_cast<float>(zeta[corner.y_neighbor] - zeta[p])};
}

/// Unit normals (3 x pixels) from the mean gradient over each pixel's corners; a pixel without any corner faces the camera.
Eigen::Matrix3Xf surface_normals(const PixelGrid& grid, const CornerList& corners,
                                 const Eigen::VectorXd& zeta);

}  // namespace rakelight
