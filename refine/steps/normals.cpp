// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/normals.h"

#include "refine/grid_rows.h"

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

constexpr Neighbor x_direction(int k) { return k % 2 == 0 ? kRight : kLeft; }
constexpr Neighbor y_direction(int k) { return k / 2 == 0 ? kDown : kUp; }

/// Bits of the first `most` corners whose two neighbours exist.
template <class Exists>
unsigned char find_corners(int most, const Exists& exists) {
  unsigned bits = 0;
  for (int k = 0, used = 0; k < kCorners && used < most; ++k) {
    if (!exists(x_direction(k)) || !exists(y_direction(k))) continue;
    bits |= 1u << k;
    ++used;
  }
  return static_cast<unsigned char>(bits);
}

int count_bits(unsigned char bits) {
  int count = 0;
  for (int k = 0; k < kCorners; ++k) count += bits >> k & 1;
  return count;
}

}  // namespace

Corner corner_at(const PixelGrid& grid, int p, int k) {
  const auto at = static_cast<size_t>(p);
  return {grid.neighbor[x_direction(k)][at], grid.neighbor[y_direction(k)][at], k % 2 == 0 ? 1.0f : -1.0f,
          k / 2 == 0 ? 1.0f : -1.0f};
}

int CornerList::first(int p) const {
  for (int k = 0; k < kCorners; ++k)
    if (has(p, k)) return k;
  return -1;
}

CornerList make_corners(const PixelGrid& grid, Stencil stencil, const std::vector<unsigned char>& cut_right,
                        const std::vector<unsigned char>& cut_down) {
  CornerList list;
  list.present.assign(static_cast<size_t>(grid.size() + kVectorPadding), 0);
  list.weight.assign(static_cast<size_t>(grid.size() + kVectorPadding), 0.0f);
  const int most = stencil == Stencil::forward ? 1 : kCorners;
  for (int p = 0; p < grid.size(); ++p) {
    const auto at = static_cast<size_t>(p);
    list.present[at] =
        find_corners(most, [&](Neighbor n) { return reachable(grid, p, n, cut_right, cut_down) >= 0; });
    if (list.present[at] != 0)
      list.weight[at] = 1.0f / static_cast<float>(count_bits(list.present[at]));
    else
      list.present[at] = find_corners(most, [&](Neighbor n) { return grid.neighbor[n][at] >= 0; });
  }
  return list;
}

NormalFrame normal_frame(const PixelGrid& grid, int p) {
  const Camera& camera = grid.camera;
  const cv::Point& pixel = grid.pixels[static_cast<size_t>(p)];
  return {static_cast<float>(camera.fx), static_cast<float>(camera.fy),
          static_cast<float>(pixel.x - camera.cx), static_cast<float>(pixel.y - camera.cy)};
}

Eigen::Matrix3Xf surface_normals(const PixelGrid& grid, const CornerList& corners,
                                 const Eigen::VectorXd& zeta) {
  Eigen::Matrix3Xf normals(3, grid.size());
  const ZetaImage image(grid, zeta);
  for_each_run(grid, [&](int y, const PixelRun& run) {
    kernels::mean_normals(image.run(corners, y, run), normals.data() + 3 * std::ptrdiff_t{run.first});
  });
  return normals;
}

}  // namespace rakelight
