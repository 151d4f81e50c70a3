// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/multigrid.h"

#include <algorithm>

namespace rakelight {
namespace {

using Eigen::Index;
using Eigen::VectorXf;

constexpr Index kCoarsestCells = 256;

/// Rows of a grid with borders on both sides, zeros.
class RowBuffers {
 public:
  RowBuffers(const GridLayout& grid, int count)
      : stride_(grid.stride() + 6 * kernels::kRowAlign), values_(static_cast<size_t>(stride_ * count)) {}
  float* operator[](int k) { return values_.data() + k * stride_ + kernels::kRowAlign; }

 private:
  Index stride_;
  std::vector<float> values_;
};

/// The row, or zeros where the grid has none.
kernels::StencilRow row_or_zeros(const StencilGrid& grid, int y, const float* zeros) {
  if (y >= 0 && y < grid.height) return grid.row(y);
  return {zeros, zeros, zeros, zeros, zeros, 0, grid.width};
}

/// Rows of the coarser stencil at the fine rows [begin, end), begin even.
void make_coarser(const StencilGrid& fine, int begin, int end, StencilGrid& coarse) {
  RowBuffers rows(fine, 6);
  const kernels::BandRow itself{nullptr, rows[1], rows[2]}, to_next{rows[3], rows[4], rows[5]};
  const int coarse_end = end == fine.height ? coarse.height : end / 2;
  for (int y = begin / 2; y < coarse_end; ++y) {
    kernels::collapse_rows(row_or_zeros(fine, 2 * y - 1, rows[0]), row_or_zeros(fine, 2 * y, rows[0]),
                           row_or_zeros(fine, 2 * y + 1, rows[0]), itself, to_next);
    kernels::collapse_along(itself, to_next, coarse.width, coarse.entries(0, y));
  }
}

/// Gauss-Seidel on one level. A pass over it is done strip by strip, then at the seams between the strips.
class Relaxation {
 public:
  Relaxation(const StencilGrid& A, const LineSolver& lines, const VectorXf& r, VectorXf& x)
      : A_(A), lines_(lines), r_(r), x_(x) {}

  /// All rows of one colour. @param first_visit x counts as 0
  void relax(Color color, bool first_visit) const {
    for_row_strips(A_, [&](int begin, int) {
      LineSolver::Workspace workspace(A_);
      relax(lines_.in_strip(begin, color), {0, A_.height}, first_visit, workspace);
    });
    if (color == even) return;
    for_seams([&](size_t k, LineSolver::Workspace& workspace) {
      relax(lines_.seams(LineSolver::seam_odd)[k], {0, A_.height}, first_visit, workspace);
    });
  }

  /// Even rows, odd rows, and the coarse right-hand side: then odd rows have no residual.
  void relax_and_restrict(bool first_visit, const StencilGrid& coarse, VectorXf& coarse_r) const {
    const auto restrict_row = [&](int y, RowBuffers& residual) {
      restrict_residual(y, first_visit, coarse, residual[0], coarse_r);
    };
    for_row_strips(A_, [&](int begin, int end) {
      LineSolver::Workspace workspace(A_);
      RowBuffers residual(A_, 1);
      relax(lines_.in_strip(begin, even), {begin, end}, first_visit, workspace);
      relax(lines_.in_strip(begin, odd), {begin, end}, false, workspace);
      const cv::Range inner = away_from_seams(begin, end);
      for (int y = inner.start; y < inner.end; y += 2) restrict_row(y, residual);
    });
    for_seams([&](size_t k, LineSolver::Workspace& workspace) {
      RowBuffers residual(A_, 1);
      relax(lines_.seams(LineSolver::seam_odd)[k], {0, A_.height}, false, workspace);
      for (const auto beside : {LineSolver::seam_above, LineSolver::seam_below})
        for (const int y : lines_.seams(beside)[k].rows)
          if (y >= 0) restrict_row(y, residual);
    });
  }

  /// Adds the coarse correction to the even rows, relaxes odd rows (whatever they hold) and even rows.
  void correct_and_relax(const StencilGrid& coarse, const VectorXf& correction) const {
    correct_and_relax(coarse, correction, [](int, int) {});
  }

  /// The same, and then Ax = A x on the way. @return x' A x and r' x
  Products correct_relax_and_multiply(const StencilGrid& coarse, const VectorXf& correction,
                                      VectorXf& Ax) const {
    ProductsOfRows products(A_);
    correct_and_relax(coarse, correction, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) products.multiply(A_, y, x_, r_, Ax);
    });
    return products.sum();
  }

 private:
  using Group = LineSolver::Group;

  /// @param finished  called as finished(first row, last row + 1) for rows that are done, with their neighbours
  template <class Finished>
  void correct_and_relax(const StencilGrid& coarse, const VectorXf& correction,
                         const Finished& finished) const {
    for_row_strips(A_, [&](int begin, int end) {
      LineSolver::Workspace workspace(A_);
      for (int y = begin; y < end; y += 2) {
        const Index i = A_.at(0, y);
        kernels::prolong_row(correction.data() + coarse.at(0, y / 2), A_.diagonal.data() + i, A_.width,
                             x_.data() + i);
      }
      const cv::Range inner = away_from_seams(begin, end);
      relax(lines_.in_strip(begin, odd), {begin, end}, false, workspace);
      relax(lines_.in_strip(begin, even), inner, false, workspace);
      finished(inner.start, end == A_.height ? end : inner.end - 1);
    });
    for_seams([&](size_t k, LineSolver::Workspace& workspace) {
      for (const auto rows : {LineSolver::seam_odd, LineSolver::seam_above, LineSolver::seam_below})
        relax(lines_.seams(rows)[k], {0, A_.height}, false, workspace);
      for (const int y : lines_.seams(LineSolver::seam_odd)[k].rows)
        if (y >= 0) finished(y - 2, std::min(y + 3, A_.height));
    });
  }

  void relax(const std::vector<Group>& groups, cv::Range rows, bool first_visit,
             LineSolver::Workspace& workspace) const {
    for (const Group& group : groups) relax(group, rows, first_visit, workspace);
  }

  void relax(const Group& group, cv::Range rows, bool first_visit, LineSolver::Workspace& workspace) const {
    if (first_visit) return lines_.solve(A_, group, rows, workspace, r_, x_);
    for (const int y : group.rows) {
      if (y < rows.start || y >= rows.end) continue;
      const Index i = A_.at(0, y);
      kernels::subtract_other_rows(A_.row(y), x_.data() + i, r_.data() + i, x_.data() + i);
    }
    lines_.solve(A_, group, rows, workspace, x_, x_);
  }

  /// Even rows of a strip whose odd neighbours are all in the strip.
  cv::Range away_from_seams(int begin, int end) const {
    return {begin == 0 ? 0 : begin + 2, end == A_.height ? end : end - 2};
  }

  template <class Body>
  void for_seams(const Body& body) const {
    for_each_in_parallel(A_, static_cast<int>(lines_.seams(LineSolver::seam_odd).size()), [&](int k) {
      LineSolver::Workspace workspace(A_);
      body(static_cast<size_t>(k), workspace);
    });
  }

  /// Of an even row. After one sweep from x = 0 its residual is what the odd rows brought in.
  void restrict_residual(int y, bool one_sweep, const StencilGrid& coarse, float* residual,
                         VectorXf& coarse_r) const {
    const Index fine = A_.at(0, y), i = coarse.at(0, y / 2);
    if (one_sweep) {
      kernels::subtract_other_rows(A_.row(y), x_.data() + fine, nullptr, residual);
    } else {
      kernels::multiply_row(A_.row(y), x_.data() + fine, residual);
      for (int u = 0; u < A_.width; ++u) residual[u] = r_[fine + u] - residual[u];
    }
    kernels::restrict_row(residual, coarse.diagonal.data() + i, coarse.width, coarse_r.data() + i);
  }

  const StencilGrid& A_;
  const LineSolver& lines_;
  const VectorXf& r_;
  VectorXf& x_;
};

Products products_of(const StencilGrid& A, const VectorXf& r, const VectorXf& x, VectorXf& Ax) {
  ProductsOfRows products(A);
  for_rows(A, [&](int y) { products.multiply(A, y, x, r, Ax); });
  return products.sum();
}

}  // namespace

void Multigrid::shape_levels() {
  if (shape_ == finest_->layout()) return;
  shape_ = *finest_;
  levels_.clear();
  levels_.emplace_back();
  for (GridLayout at = shape_; Index{at.width} * at.height > kCoarsestCells;) {
    at = {at.width / 2 + 1, at.height / 2 + 1};
    Level& level = levels_.emplace_back();
    level.own = StencilGrid(at.width, at.height);
    level.x = level.r = VectorXf::Zero(at.size());
  }
}

bool Multigrid::setup(const StencilGrid& finest) {
  finest_ = &finest;
  shape_levels();
  for (size_t k = 0; k < levels_.size(); ++k) {
    const StencilGrid& A = stencil(k);
    LineSolver& lines = levels_[k].lines;
    lines.prepare(A);
    for_row_strips(A, [&](int begin, int end) {
      lines.factorize_strip(A, begin);
      if (k + 1 < levels_.size()) make_coarser(A, begin, end, levels_[k + 1].own);
    });
    if (!lines.factorize_seams(A)) return false;
  }
  return factorize_coarsest();
}

bool Multigrid::factorize_coarsest() {
  const StencilGrid& A = stencil(levels_.size() - 1);
  coarsest_cells_.clear();
  std::vector<Index> number(static_cast<size_t>(A.size()), -1);
  for (int y = 0; y < A.height; ++y) {
    for (Index i = A.at(0, y); i < A.at(A.width, y); ++i) {
      if (!(A.diagonal[i] > 0.0f)) continue;
      number[static_cast<size_t>(i)] = static_cast<Index>(coarsest_cells_.size());
      coarsest_cells_.push_back(i);
    }
  }
  const auto count = static_cast<Index>(coarsest_cells_.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count, count);
  for (Index k = 0; k < count; ++k) {
    const Index i = coarsest_cells_[static_cast<size_t>(k)], s = A.stride();
    const auto couple = [&](Index neighbor, float entry) {
      const Index other = number[static_cast<size_t>(neighbor)];
      if (other >= 0) dense(k, other) = dense(other, k) = static_cast<double>(entry);
    };
    couple(i, A.diagonal[i]);
    couple(i + 1, A.right[i]);
    couple(i + s, A.down[i]);
    couple(i + s + 1, A.down_right[i]);
    couple(i + s - 1, A.down_left[i]);
  }
  constexpr double kLeastPivot = 1e-4;  // it may be singular, as the lines' may
  dense.diagonal() *= 1 + kLeastPivot;
  coarsest_.compute(dense);
  return coarsest_.info() == Eigen::Success;
}

void Multigrid::apply(const VectorXf& r, VectorXf& z) {
  if (z.size() != finest_->size()) z = VectorXf::Zero(finest_->size());
  cycle(0, r, z, nullptr);
}

Products Multigrid::apply(const VectorXf& r, VectorXf& z, VectorXf& Az) {
  for (VectorXf* vector : {&z, &Az})
    if (vector->size() != finest_->size()) *vector = VectorXf::Zero(finest_->size());
  return cycle(0, r, z, &Az);
}

/// @param Ax A x afterwards, unless null  @return x' A x and r' x, unless Ax is null
Products Multigrid::cycle(size_t number, const VectorXf& r, VectorXf& x, VectorXf* Ax) {
  const StencilGrid& A = stencil(number);
  if (number + 1 == levels_.size()) {
    solve_coarsest(r, x);
    return Ax == nullptr ? Products() : products_of(A, r, x, *Ax);
  }
  Level& next = levels_[number + 1];
  const Relaxation level(A, levels_[number].lines, r, x);
  for (int sweep = 1; sweep < sweeps_; ++sweep) {
    level.relax(even, sweep == 1);
    level.relax(odd, false);
  }
  level.relax_and_restrict(sweeps_ == 1, next.own, next.r);
  cycle(number + 1, next.r, next.x, nullptr);
  if (sweeps_ == 1 && Ax != nullptr) return level.correct_relax_and_multiply(next.own, next.x, *Ax);
  level.correct_and_relax(next.own, next.x);
  for (int sweep = 1; sweep < sweeps_; ++sweep) {
    level.relax(odd, false);
    level.relax(even, false);
  }
  return Ax == nullptr ? Products() : products_of(A, r, x, *Ax);
}

void Multigrid::solve_coarsest(const VectorXf& r, VectorXf& x) const {
  Eigen::VectorXd b(static_cast<Index>(coarsest_cells_.size()));
  for (Index k = 0; k < b.size(); ++k) b[k] = static_cast<double>(r[coarsest_cells_[static_cast<size_t>(k)]]);
  const Eigen::VectorXd solution = coarsest_.solve(b);
  for (Index k = 0; k < b.size(); ++k)
    x[coarsest_cells_[static_cast<size_t>(k)]] = static_cast<float>(solution[k]);
}

}  // namespace rakelight
