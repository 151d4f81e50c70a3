// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Symmetric 9-point stencil on width x height pixels, zero outside the mask. Rows have a border of zeros that lets whole
// vectors be read and written (refine/kernels/stencil_kernels.h).
#pragma once

#include <Eigen/Core>
#include <numeric>

#include "refine/kernels/stencil_kernels.h"
#include "refine/pixel_blocks.h"

namespace rakelight {

/// How the rows of width x height pixels lie in a vector.
struct GridLayout {
  int width = 0, height = 0;

  Eigen::Index stride() const {
    return (width + kernels::kRowAlign - 1) / kernels::kRowAlign * kernels::kRowAlign + 2;
  }
  Eigen::Index at(int x, int y) const { return (y + 1) * stride() + x + 1; }

  /// Of vectors over the grid: with borders, and what a vector kernel may read past the last.
  Eigen::Index size() const { return stride() * (height + 2) + 4 * kernels::kRowAlign; }

  bool operator==(const GridLayout& other) const { return width == other.width && height == other.height; }
};

struct StencilGrid : GridLayout {
  Eigen::VectorXf diagonal;                            ///< entry (i, i); 0 outside the mask
  Eigen::VectorXf right, down, down_right, down_left;  ///< entry (i, neighbour in that direction)

  StencilGrid() = default;
  StencilGrid(int width_px, int height_px);

  const GridLayout& layout() const { return *this; }
  kernels::StencilRow row(int y) const;
  kernels::EntryRow entries(int x, int y);

  /// y = A x for vectors of size() whose borders are zeros. @return x' A x
  double multiply(const Eigen::VectorXf& x, Eigen::VectorXf& y) const;
};

/// Products of vectors over a grid.
struct Products {
  double xAx = 0, bx = 0;
};

/// Products row by row, added up in the rows' order.
class ProductsOfRows {
 public:
  explicit ProductsOfRows(const GridLayout& grid) : rows_(static_cast<size_t>(grid.height)) {}

  /// y = A x in row y. Adds x' A x and b' x of the row.
  void multiply(const StencilGrid& A, int row, const Eigen::VectorXf& x, const Eigen::VectorXf& b,
                Eigen::VectorXf& y) {
    const Eigen::Index i = A.at(0, row);
    rows_[static_cast<size_t>(row)] =
        kernels::multiply_row(A.row(row), x.data() + i, b.data() + i, y.data() + i);
  }

  Products sum() const;

 private:
  std::vector<kernels::RowProducts> rows_;
};

constexpr int kGridStrip = 32;  ///< rows that are worked on together; even

/// Calls body(k) for k = 0, 1, ..., count - 1, in parallel where the grid is worth it.
template <class Body>
void for_each_in_parallel(const GridLayout& grid, int count, const Body& body) {
  constexpr Eigen::Index kWorthThreads = 16384;  // pixels; smaller grids run faster in one thread
  const auto run = [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) body(k);
  };
  if (grid.size() < kWorthThreads)
    run({0, count});
  else
    cv::parallel_for_(cv::Range(0, count), run);
}

/// Calls body(first row, last row + 1) for strips of a grid's rows.
template <class Body>
void for_row_strips(const GridLayout& grid, const Body& body) {
  for_each_in_parallel(grid, (grid.height + kGridStrip - 1) / kGridStrip, [&](int strip) {
    body(strip * kGridStrip, std::min(grid.height, (strip + 1) * kGridStrip));
  });
}

/// Calls body(y) for every row.
template <class Body>
void for_rows(const GridLayout& grid, const Body& body) {
  for_row_strips(grid, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) body(y);
  });
}

/// Sum over the rows of body(y), a float each, in a fixed order.
template <class Body>
double sum_over_rows(const GridLayout& grid, const Body& body) {
  std::vector<double> sums(static_cast<size_t>(grid.height));
  for_rows(grid, [&](int y) { sums[static_cast<size_t>(y)] = static_cast<double>(body(y)); });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace rakelight
