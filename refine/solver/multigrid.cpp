// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/multigrid.h"

#include <algorithm>

namespace rakelight {
namespace {

using Eigen::Index;
using Eigen::VectorXf;

constexpr Index kCoarsestCells = 256;

enum Color { even = 0, odd = 1 };

/// Scratch of one row of a grid with borders on both sides, zeros.
struct RowBuffer {
  std::vector<float> values;

  explicit RowBuffer(const StencilGrid& grid)
      : values(static_cast<size_t>(grid.stride()) + 6 * kernels::kRowAlign) {}
  float* begin() { return values.data() + kernels::kRowAlign; }
};

/// The row, or zeros where the grid has none.
kernels::StencilRow row_or_zeros(const StencilGrid& grid, int y, RowBuffer& zeros) {
  if (y >= 0 && y < grid.height) return grid.row(y);
  return {zeros.begin(), zeros.begin(), zeros.begin(), zeros.begin(), zeros.begin(), 0, grid.width};
}

StencilGrid coarser(const StencilGrid& fine) {
  StencilGrid coarse(fine.width / 2 + 1, fine.height / 2 + 1);
  for_rows(coarse, 0, 1, [&](int y) {
    RowBuffer zeros(fine), same(fine), right(fine), below(fine), below_right(fine), below_left(fine);
    const kernels::BandRow itself{nullptr, same.begin(), right.begin()};
    const kernels::BandRow to_next{below_left.begin(), below.begin(), below_right.begin()};
    kernels::collapse_rows(row_or_zeros(fine, 2 * y - 1, zeros), row_or_zeros(fine, 2 * y, zeros),
                           row_or_zeros(fine, 2 * y + 1, zeros), itself, to_next);
    const Index i = coarse.at(0, y);
    kernels::collapse_along(itself, to_next,
                            {coarse.diagonal.data() + i, coarse.right.data() + i, coarse.down.data() + i,
                             coarse.down_right.data() + i, coarse.down_left.data() + i, coarse.width});
  });
  return coarse;
}

/// Gauss-Seidel over the rows of one colour. @param first_visit x counts as 0
void relax(const StencilGrid& A, const LineSolver& lines, Color color, const VectorXf& r, bool first_visit,
           VectorXf& x) {
  for_rows(A, color, 2 * LineSolver::kRowsAtOnce, [&](int first) {
    for (int k = 0, y = first; k < LineSolver::kRowsAtOnce && y < A.height; ++k, y += 2) {
      const Index i = A.at(0, y);
      if (first_visit)
        x.segment(i, A.width) = r.segment(i, A.width);
      else
        kernels::subtract_other_rows(A.row(y), x.data() + i, r.data() + i, x.data() + i);
    }
    lines.solve(A, first, 2, x);
  });
}

/// Coarse right-hand side, after even and odd rows were relaxed in that order: then the odd rows have no residual. After one
/// sweep from x = 0 the even ones have what the odd ones brought in.
void restrict_residual(const StencilGrid& A, const VectorXf& r, bool one_sweep, const VectorXf& x,
                       const StencilGrid& coarse, VectorXf& coarse_r) {
  for_rows(coarse, 0, 1, [&](int y) {
    RowBuffer residual(A);
    if (2 * y < A.height) {
      const Index fine = A.at(0, 2 * y);
      if (one_sweep) {
        kernels::subtract_other_rows(A.row(2 * y), x.data() + fine, nullptr, residual.begin());
      } else {
        kernels::multiply_row(A.row(2 * y), x.data() + fine, residual.begin());
        for (int u = 0; u < A.width; ++u) residual.begin()[u] = r[fine + u] - residual.begin()[u];
      }
    }
    const Index i = coarse.at(0, y);
    kernels::restrict_row(residual.begin(), coarse.diagonal.data() + i, coarse.width, coarse_r.data() + i);
  });
}

/// Adds the coarse correction to the even rows; the odd ones are relaxed next, whatever they hold.
void correct_even_rows(const StencilGrid& coarse, const VectorXf& correction, const StencilGrid& A,
                       VectorXf& x) {
  for_rows(A, even, 2, [&](int y) {
    const Index i = A.at(0, y);
    kernels::prolong_row(correction.data() + coarse.at(0, y / 2), A.diagonal.data() + i, A.width,
                         x.data() + i);
  });
}

}  // namespace

bool Multigrid::setup(StencilGrid finest) {
  levels_.clear();
  levels_.emplace_back();
  levels_.back().A = std::move(finest);
  const auto cells = [](const StencilGrid& A) { return Index{A.width} * A.height; };
  while (cells(levels_.back().A) > kCoarsestCells) {
    StencilGrid next = coarser(levels_.back().A);
    levels_.emplace_back();
    levels_.back().A = std::move(next);
    levels_.back().x = levels_.back().r = VectorXf::Zero(levels_.back().A.size());
  }
  for (Level& level : levels_) {
    if (!level.lines.factorize(level.A)) return false;
  }
  return factorize_coarsest();
}

bool Multigrid::factorize_coarsest() {
  const StencilGrid& A = levels_.back().A;
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
  if (z.size() != finest().size()) z = VectorXf::Zero(finest().size());
  cycle(0, r, z);
}

void Multigrid::cycle(size_t number, const VectorXf& r, VectorXf& x) {
  if (number + 1 == levels_.size()) return solve_coarsest(r, x);
  const Level& level = levels_[number];
  Level& next = levels_[number + 1];
  for (int sweep = 0; sweep < sweeps_; ++sweep) {
    relax(level.A, level.lines, even, r, sweep == 0, x);
    relax(level.A, level.lines, odd, r, false, x);
  }
  restrict_residual(level.A, r, sweeps_ == 1, x, next.A, next.r);
  cycle(number + 1, next.r, next.x);
  correct_even_rows(next.A, next.x, level.A, x);
  for (int sweep = 0; sweep < sweeps_; ++sweep) {
    relax(level.A, level.lines, odd, r, false, x);
    relax(level.A, level.lines, even, r, false, x);
  }
}

void Multigrid::solve_coarsest(const VectorXf& r, VectorXf& x) const {
  Eigen::VectorXd b(static_cast<Index>(coarsest_cells_.size()));
  for (Index k = 0; k < b.size(); ++k) b[k] = static_cast<double>(r[coarsest_cells_[static_cast<size_t>(k)]]);
  const Eigen::VectorXd solution = coarsest_.solve(b);
  for (Index k = 0; k < b.size(); ++k)
    x[coarsest_cells_[static_cast<size_t>(k)]] = static_cast<float>(solution[k]);
}

}  // namespace rakelight
