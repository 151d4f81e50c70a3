// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tridiagonal systems along the rows of a stencil, factorised L D L', kLines rows of one colour (even or odd) side by side.
//
// Rows are grouped so that a relaxation can go over a strip of rows once for both colours and without asking what its
// neighbours do: the last odd row of a strip couples to the next strip and waits in a seam, and so do the even rows beside it
// where they follow the odd ones.
#pragma once

#include <array>
#include <memory>

#include "refine/solver/stencil_grid.h"

namespace rakelight {

enum Color { even = 0, odd = 1 };

class LineSolver {
 public:
  /// Rows solved together; -1: none.
  struct Group {
    std::array<int, kernels::kLines> rows;
    size_t number = 0;
  };

  /// What solve() works in, one for each thread.
  class Workspace {
   public:
    explicit Workspace(const GridLayout& grid)
        : scratch_(new float[static_cast<size_t>(grid.stride() * kernels::kLines)]),
          nowhere_(static_cast<size_t>(grid.stride())) {}

   private:
    friend class LineSolver;
    std::unique_ptr<float[]> scratch_;
    std::vector<float> nowhere_;  ///< zeros, which stay zeros: in place of a row that a group does not have
  };

  /// Groups the rows; then every strip is to be factorised, side by side if you like, and the seams.
  void prepare(const GridLayout& grid);
  void factorize_strip(const StencilGrid& A, int begin);

  /// @return false when a row of a strip or seam is seen not to be positive definite
  bool factorize_seams(const StencilGrid& A);

  /// x = inv(T_y) b in the rows of a group that are in `rows`; b may be x.
  void solve(const StencilGrid& A, const Group& group, cv::Range rows, Workspace& workspace,
             const Eigen::VectorXf& b, Eigen::VectorXf& x) const;

  /// Rows of the strip that begins at row `begin`; the odd ones without the last where another strip follows.
  const std::vector<Group>& in_strip(int begin, Color color) const {
    return strips_[static_cast<size_t>(begin / kGridStrip)][color];
  }

  /// The rows that odd ones of in_strip leave out, and the even rows above or below them.
  enum SeamRow { seam_odd, seam_above, seam_below };
  const std::vector<Group>& seams(SeamRow which) const { return seams_[which]; }

 private:
  void group_rows(const GridLayout& grid);
  void add_groups(const std::vector<int>& rows, std::vector<Group>& groups);
  float least_pivot(const StencilGrid& A, const std::vector<Group>& groups);
  float* factors_of(const Group& group) {
    return factors_.data() + group.number * static_cast<size_t>(columns_ * kernels::kLineFactors);
  }
  const float* factors_of(const Group& group) const {
    return const_cast<LineSolver*>(this)->factors_of(group);
  }

  GridLayout grouped_;
  int columns_ = 0;
  size_t groups_ = 0;
  std::vector<std::array<std::vector<Group>, 2>> strips_;
  std::array<std::vector<Group>, 3> seams_;
  std::vector<float> nowhere_;  ///< zeros: a row that a group does not have
  std::vector<float> factors_, least_of_strip_;
};

}  // namespace rakelight
