// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/line_solver.h"

#include <algorithm>
#include <utility>

namespace rakelight {
namespace {

using Eigen::Index;
using kernels::kLines;

/// Pointers to the group's rows of a vector over the grid, those in `range`.
template <class Number>
void point_at_rows(const GridLayout& grid, const LineSolver::Group& group, cv::Range range, Number* vector,
                   Number* nowhere, Number* (&rows)[kLines]) {
  for (size_t k = 0; k < kLines; ++k) {
    const int y = group.rows[k];
    rows[k] = range.start <= y && y < range.end ? vector + grid.at(0, y) : nowhere;
  }
}

}  // namespace

void LineSolver::add_groups(const std::vector<int>& rows, std::vector<Group>& groups) {
  for (size_t first = 0; first < rows.size(); first += kLines) {
    Group group;
    group.rows.fill(-1);
    std::copy(rows.begin() + static_cast<std::ptrdiff_t>(first),
              rows.begin() + static_cast<std::ptrdiff_t>(std::min(rows.size(), first + kLines)),
              group.rows.begin());
    group.number = groups_++;
    groups.push_back(group);
  }
}

void LineSolver::group_rows(const GridLayout& grid) {
  grouped_ = grid;
  columns_ = (grid.width + 3) / 4 * 4;
  groups_ = 0;
  strips_.clear();
  std::array<std::vector<int>, 3> seams;
  for (int begin = 0; begin < grid.height; begin += kGridStrip) {
    const int end = begin + kGridStrip;
    const bool last = end >= grid.height;
    std::array<std::vector<int>, 2> rows;
    for (int y = begin; y < std::min(end, grid.height); ++y)
      if (last || y + 1 < end) rows[static_cast<size_t>(y % 2)].push_back(y);
    strips_.emplace_back();
    for (const Color color : {even, odd}) add_groups(rows[color], strips_.back()[color]);
    if (last) break;
    seams[seam_odd].push_back(end - 1);
    seams[seam_above].push_back(end - 2);
    seams[seam_below].push_back(end);
  }
  for (const SeamRow which : {seam_odd, seam_above, seam_below}) {
    seams_[which].clear();
    add_groups(seams[which], seams_[which]);
  }
  nowhere_.assign(static_cast<size_t>(grid.stride()), 0.0f);
  least_of_strip_.resize(strips_.size());
  factors_.resize(groups_ * static_cast<size_t>(columns_ * kernels::kLineFactors));
}

void LineSolver::prepare(const GridLayout& grid) {
  if (!(grouped_ == grid)) group_rows(grid);
}

float LineSolver::least_pivot(const StencilGrid& A, const std::vector<Group>& groups) {
  float least = 1;
  for (const Group& group : groups) {
    const float *diagonal[kLines], *right[kLines];
    point_at_rows(A, group, {0, A.height}, A.diagonal.data(), std::as_const(nowhere_).data(), diagonal);
    point_at_rows(A, group, {0, A.height}, A.right.data(), std::as_const(nowhere_).data(), right);
    least = std::min(least, kernels::factorize_lines(diagonal, right, A.width, factors_of(group)));
  }
  return least;
}

void LineSolver::factorize_strip(const StencilGrid& A, int begin) {
  const auto strip = static_cast<size_t>(begin / kGridStrip);
  least_of_strip_[strip] =
      std::min(least_pivot(A, strips_[strip][even]), least_pivot(A, strips_[strip][odd]));
}

bool LineSolver::factorize_seams(const StencilGrid& A) {
  float least = *std::min_element(least_of_strip_.begin(), least_of_strip_.end());
  for (const auto& groups : seams_) least = std::min(least, least_pivot(A, groups));
  return least > 0.0f;
}

void LineSolver::solve(const StencilGrid& A, const Group& group, cv::Range range, Workspace& workspace,
                       const Eigen::VectorXf& b, Eigen::VectorXf& x) const {
  const float* right_sides[kLines];
  float* rows[kLines];
  point_at_rows(A, group, range, b.data(), std::as_const(workspace.nowhere_).data(), right_sides);
  point_at_rows(A, group, range, x.data(), workspace.nowhere_.data(), rows);
  kernels::solve_lines(factors_of(group), A.width, right_sides, rows, workspace.scratch_.get());
}

}  // namespace rakelight
