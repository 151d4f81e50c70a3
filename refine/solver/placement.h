// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a grid's pixels lie in the vectors of a StencilGrid over its box.
#pragma once

#include "refine/pixel_grid.h"
#include "refine/solver/stencil_grid.h"

namespace rakelight {

class Placement {
 public:
  explicit Placement(const PixelGrid& grid) : grid_(grid), layout_{grid.box.width, grid.box.height} {}

  const GridLayout& layout() const { return layout_; }

  Eigen::Index place(int p) const {
    const cv::Point at = grid_.pixels[static_cast<size_t>(p)];
    return layout_.at(at.x - grid_.box.x, at.y - grid_.box.y);
  }

  Eigen::VectorXf zeros() const { return Eigen::VectorXf::Zero(layout_.size()); }

  /// Copies numbers of the pixels, times `factor`, to their places; all other places stay.
  void scatter(const Eigen::VectorXd& pixels, double factor, Eigen::VectorXf& placed) const {
    for_each_run([&](int p, Eigen::Index i, int count) {
      for (int k = 0; k < count; ++k) placed[i + k] = static_cast<float>(factor * pixels[p + k]);
    });
  }

  /// The opposite.
  void gather(const Eigen::VectorXf& placed, double factor, Eigen::VectorXd& pixels) const {
    gather([&](Eigen::Index i) { return factor * static_cast<double>(placed[i]); }, pixels);
  }

  /// The number that value(place) gives for each pixel.
  template <class Value>
  void gather(const Value& value, Eigen::VectorXd& pixels) const {
    pixels.resize(grid_.size());
    for_each_run([&](int p, Eigen::Index i, int count) {
      for (int k = 0; k < count; ++k) pixels[p + k] = value(i + k);
    });
  }

 private:
  /// Calls body(first pixel, its place, count) for every run of pixels.
  template <class Body>
  void for_each_run(const Body& body) const {
    for_rows(layout_, [&](int y) {
      for (int k = grid_.first_run[static_cast<size_t>(y)]; k < grid_.first_run[static_cast<size_t>(y) + 1];
           ++k) {
        const PixelRun& run = grid_.runs[static_cast<size_t>(k)];
        body(run.first, layout_.at(run.x - grid_.box.x, y), run.count);
      }
    });
  }

  const PixelGrid& grid_;
  GridLayout layout_;
};

}  // namespace rakelight
