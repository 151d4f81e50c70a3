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
  explicit Placement(const PixelGrid& grid);

  Eigen::Index place(int p) const {
    const cv::Point at = grid_.pixels[static_cast<size_t>(p)];
    return layout_.at(at.x - grid_.box.x, at.y - grid_.box.y);
  }

  /// A stencil of zeros.
  StencilGrid stencil() const { return {layout_.width, layout_.height}; }
  Eigen::VectorXf zeros() const { return Eigen::VectorXf::Zero(layout_.size()); }

  /// Copies numbers of the pixels, times `factor`, to their places; all other places stay.
  template <class Number>
  void scatter(const Number* pixels, Number factor, Eigen::VectorXf& placed) const {
    for_each_copied_run([&](int p, Eigen::Index i, int count) {
      for (int k = 0; k < count; ++k) placed[i + k] = static_cast<float>(factor * pixels[p + k]);
    });
  }

  /// The opposite.
  void gather(const Eigen::VectorXf& placed, double factor, Eigen::VectorXd& pixels) const {
    pixels.resize(grid_.size());
    for_each_copied_run([&](int p, Eigen::Index i, int count) {
      for (int k = 0; k < count; ++k) pixels[p + k] = factor * static_cast<double>(placed[i + k]);
    });
  }

 private:
  template <class Body>
  void for_each_copied_run(const Body& body) const {
    cv::parallel_for_(cv::Range(0, static_cast<int>(grid_.runs.size())), [&](const cv::Range& range) {
      for (int k = range.start; k < range.end; ++k) {
        const PixelRun& run = grid_.runs[static_cast<size_t>(k)];
        body(run.first, place(run.first), run.count);
      }
    });
  }

  struct Layout : StencilGrid {  // its shape only: no entries
    explicit Layout(cv::Size size) { width = size.width, height = size.height; }
  };

  const PixelGrid& grid_;
  Layout layout_;
};

}  // namespace rakelight
