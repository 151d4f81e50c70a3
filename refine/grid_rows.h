// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A grid's rows for the vector kernels (refine/kernels/corner_kernels.h): values as an image with readable borders, loops over
// strips of rows whose split does not depend on the number of threads.
#pragma once

#include "refine/kernels/corner_kernels.h"
#include "refine/pixel_blocks.h"
#include "refine/steps/normals.h"

namespace rakelight {

constexpr int kRowStrip = 32;
constexpr int kVectorPadding = 32;  ///< numbers a vector kernel may read or write past the last one asked for

/// zeta over the grid's box, relative to one of its values so that floats hold its differences; 0 outside the mask.
class ZetaImage {
 public:
  ZetaImage(const PixelGrid& grid, const Eigen::VectorXd& zeta);

  /// The run of the box's row y with its neighbours.
  kernels::CornerRun run(const CornerList& corners, int y, const PixelRun& run) const;

 private:
  const PixelGrid& grid_;
  std::ptrdiff_t stride_;
  std::vector<float> values_;
};

/// Calls body(first row, last row + 1) for strips of the box's rows, in parallel.
template <class Body>
void for_each_strip(const PixelGrid& grid, const Body& body) {
  const int rows = grid.box.height;
  cv::parallel_for_(cv::Range(0, (rows + kRowStrip - 1) / kRowStrip), [&](const cv::Range& range) {
    for (int strip = range.start; strip < range.end; ++strip)
      body(strip * kRowStrip, std::min(rows, (strip + 1) * kRowStrip));
  });
}

/// Calls body(run) for the runs of the box's row y.
template <class Body>
void for_each_run(const PixelGrid& grid, int y, const Body& body) {
  for (int k = grid.first_run[static_cast<size_t>(y)]; k < grid.first_run[static_cast<size_t>(y) + 1]; ++k)
    body(grid.runs[static_cast<size_t>(k)]);
}

/// Calls body(y, run) for every run, strip by strip in parallel.
template <class Body>
void for_each_run(const PixelGrid& grid, const Body& body) {
  for_each_strip(grid, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) for_each_run(grid, y, [&](const PixelRun& run) { body(y, run); });
  });
}

/// Sum over the runs of body(y, run), a float each, in a fixed order.
template <class Body>
double sum_over_runs(const PixelGrid& grid, const Body& body) {
  std::vector<double> sums(static_cast<size_t>(grid.box.height / kRowStrip + 1), 0.0);
  for_each_strip(grid, [&](int begin, int end) {
    double& sum = sums[static_cast<size_t>(begin / kRowStrip)];
    for (int y = begin; y < end; ++y)
      for_each_run(grid, y, [&](const PixelRun& run) { sum += static_cast<double>(body(y, run)); });
  });
  double total = 0;
  for (const double sum : sums) total += sum;
  return total;
}

}  // namespace rakelight
