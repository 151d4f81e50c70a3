// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/pixel_grid.h"

#include <algorithm>

namespace rakelight {
namespace {

void find_runs(PixelGrid& grid) {
  if (grid.pixels.empty()) return;
  int left = grid.index.cols, right = -1, row = grid.pixels.front().y;
  grid.first_run.push_back(0);
  for (int p = 0; p < grid.size(); ++p) {
    const cv::Point at = grid.pixels[static_cast<size_t>(p)];
    left = std::min(left, at.x);
    right = std::max(right, at.x);
    for (; row < at.y; ++row) grid.first_run.push_back(static_cast<int>(grid.runs.size()));
    const bool continues = p > 0 && grid.pixels[static_cast<size_t>(p) - 1] == at - cv::Point(1, 0);
    if (!continues) grid.runs.push_back({p, 0, at.x});
    ++grid.runs.back().count;
  }
  grid.first_run.push_back(static_cast<int>(grid.runs.size()));
  const int top = grid.pixels.front().y;
  grid.box = {left, top, right - left + 1, row - top + 1};
}

}  // namespace

PixelGrid make_pixel_grid(const Camera& camera, const cv::Mat1b& mask) {
  PixelGrid grid;
  grid.camera = camera;
  grid.index = cv::Mat1i(mask.size(), -1);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      if (mask(v, u) == 0) continue;
      grid.index(v, u) = grid.size();
      grid.pixels.emplace_back(u, v);
    }
  }
  const auto number_at = [&](int u, int v) {
    return u < 0 || v < 0 || u >= mask.cols || v >= mask.rows ? -1 : grid.index(v, u);
  };
  for (auto& list : grid.neighbor) list.reserve(grid.pixels.size());
  for (const cv::Point& p : grid.pixels) {
    grid.neighbor[kRight].push_back(number_at(p.x + 1, p.y));
    grid.neighbor[kDown].push_back(number_at(p.x, p.y + 1));
    grid.neighbor[kLeft].push_back(number_at(p.x - 1, p.y));
    grid.neighbor[kUp].push_back(number_at(p.x, p.y - 1));
  }
  find_runs(grid);
  return grid;
}

Eigen::VectorXd gather(const PixelGrid& grid, const cv::Mat1f& image) {
  Eigen::VectorXd values(grid.size());
  for (int p = 0; p < grid.size(); ++p)
    values[p] = static_cast<double>(image(grid.pixels[static_cast<size_t>(p)]));
  return values;
}

cv::Mat1f scatter(const PixelGrid& grid, const Eigen::VectorXd& values, float outside) {
  cv::Mat1f image(grid.index.size(), outside);
  for (int p = 0; p < grid.size(); ++p)
    image(grid.pixels[static_cast<size_t>(p)]) = static_cast<float>(values[p]);
  return image;
}

}  // namespace rakelight
