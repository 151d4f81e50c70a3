// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/normals.h"

#include <algorithm>

#include "refine/pixel_blocks.h"

namespace rakelight {
namespace {

/// Neighbour of p in a direction, or -1 if it is outside the mask or across a cut.
int reachable(const PixelGrid& grid, int p, Neighbor direction, const std::vector<unsigned char>& cut_right,
              const std::vector<unsigned char>& cut_down) {
  const int q = grid.neighbor[direction][static_cast<size_t>(p)];
  if (q < 0) return -1;
  const auto& cuts = direction == kRight || direction == kLeft ? cut_right : cut_down;
  if (cuts.empty()) return q;
  const int first = direction == kRight || direction == kDown ? p : q;
  return cuts[static_cast<size_t>(first)] ? -1 : q;
}

/// Up to `most` corners whose two neighbours exist. @return how many
template <class NeighborAt>
int find_corners(int most, const NeighborAt& neighbor_at, std::array<Corner, 4>& corners) {
  int used = 0;
  for (const auto& [y_direction, y_sign] : {std::pair(kDown, 1.0f), std::pair(kUp, -1.0f)}) {
    for (const auto& [x_direction, x_sign] : {std::pair(kRight, 1.0f), std::pair(kLeft, -1.0f)}) {
      const Corner corner{neighbor_at(x_direction), neighbor_at(y_direction), x_sign, y_sign};
      if (corner.x_neighbor < 0 || corner.y_neighbor < 0 || used == most) continue;
      corners[static_cast<size_t>(used++)] = corner;
    }
  }
  return used;
}

}  // namespace

CornerList make_corners(const PixelGrid& grid, Stencil stencil, const std::vector<unsigned char>& cut_right,
                        const std::vector<unsigned char>& cut_down) {
  CornerList list;
  list.corners.resize(static_cast<size_t>(grid.size()));
  list.weight.assign(static_cast<size_t>(grid.size()), 0.0f);
  for (int p = 0; p < grid.size(); ++p) {
    auto& corners = list.corners[static_cast<size_t>(p)];
    const int most = stencil == Stencil::forward ? 1 : 4;
    const int used = find_corners(most, [&](Neighbor n) { return reachable(grid, p, n, cut_right, cut_down); }, corners);
    if (used > 0) {
      list.weight[static_cast<size_t>(p)] = 1.0f / static_cast<float>(used);
    } else {
      find_corners(most, [&](Neighbor n) { return grid.neighbor[n][static_cast<size_t>(p)]; }, corners);
    }
  }
  return list;
}

NormalFrame normal_frame(const PixelGrid& grid, int p) {
  const Camera& camera = grid.camera;
  const cv::Point& pixel = grid.pixels[static_cast<size_t>(p)];
  return {static_cast<float>(camera.fx), static_cast<float>(camera.fy), static_cast<float>(pixel.x - camera.cx),
          static_cast<float>(pixel.y - camera.cy)};
}

Eigen::Matrix3Xf surface_normals(const PixelGrid& grid, const CornerList& corners, const Eigen::VectorXd& zeta) {
  Eigen::Matrix3Xf normals(3, grid.size());
  for_each_block(grid.size(), [&](int begin, int end) {
    for (int p = begin; p < end; ++p) {
      Eigen::Vector2f gradient = Eigen::Vector2f::Zero();
      float count = 0;
      for (const Corner& corner : corners.corners[static_cast<size_t>(p)]) {
        if (corner.x_neighbor < 0) break;
        gradient += corner_gradient(corner, p, zeta);
        ++count;
      }
      gradient /= std::max(1.0f, count);
      normals.col(p) = normal_frame(grid, p).raw(gradient.x(), gradient.y()).normalized();
    }
  });
  return normals;
}

}  // namespace rakelight
