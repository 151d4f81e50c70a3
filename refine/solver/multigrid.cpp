// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/multigrid.h"

#include <algorithm>
#include <array>
#include <opencv2/core/utility.hpp>

namespace rakelight {
namespace {

using Eigen::Index;
using Eigen::VectorXf;

constexpr Index kCoarsestCells = 256;
constexpr Index kWorthThreads = 16384;  // pixels; smaller levels run faster in one thread

/// Calls body(y) for first, first + step, ... below count.
template <class Body>
void for_rows(const StencilGrid& A, int first, int step, const Body& body) {
  const int rows = (A.height - first + step - 1) / step;
  if (A.size() < kWorthThreads) {
    for (int k = 0; k < rows; ++k) body(first + k * step);
    return;
  }
  cv::parallel_for_(cv::Range(0, rows), [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) body(first + k * step);
  });
}

/// What the rows above and below contribute to A x at i.
float from_other_rows(const StencilGrid& A, const VectorXf& x, Index i) {
  const Index s = A.stride();
  return A.down[i] * x[i + s] + A.down[i - s] * x[i - s] + A.down_right[i] * x[i + s + 1] +
         A.down_right[i - s - 1] * x[i - s - 1] + A.down_left[i] * x[i + s - 1] +
         A.down_left[i - s + 1] * x[i - s + 1];
}

void multiply_row(const StencilGrid& A, const VectorXf& x, int y, VectorXf& out) {
  for (Index i = A.at(0, y); i < A.at(A.width, y); ++i)
    out[i] =
        A.diagonal[i] * x[i] + A.right[i] * x[i + 1] + A.right[i - 1] * x[i - 1] + from_other_rows(A, x, i);
}

/// A full stencil entry: from pixel i towards (dx, dy).
float entry(const StencilGrid& A, Index i, int dx, int dy) {
  const Index j = i + dy * A.stride() + dx;
  if (dy == 0) return dx == 0 ? A.diagonal[i] : dx > 0 ? A.right[i] : A.right[j];
  const Index upper = dy > 0 ? i : j;
  if (dx == 0) return A.down[upper];
  return (dx > 0) == (dy > 0) ? A.down_right[upper] : A.down_left[upper];
}

float transfer_weight(int dx, int dy) { return (dx == 0 ? 1.0f : 0.5f) * (dy == 0 ? 1.0f : 0.5f); }

/// Row X of A P around fine pixel (2X, 2Y), summed with the weights of restriction: values at fine offsets -2..2.
using Patch = std::array<std::array<float, 5>, 5>;

Patch restricted_rows(const StencilGrid& fine, int x, int y) {
  Patch patch{};
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= fine.width || v >= fine.height) continue;
      const Index i = fine.at(u, v);
      if (fine.diagonal[i] == 0.0f) continue;
      const float w = transfer_weight(dx, dy);
      for (int ey = -1; ey <= 1; ++ey)
        for (int ex = -1; ex <= 1; ++ex)
          patch[static_cast<size_t>(2 + dy + ey)][static_cast<size_t>(2 + dx + ex)] +=
              w * entry(fine, i, ex, ey);
    }
  }
  return patch;
}

/// Entry of R A P from the patch's coarse pixel to the one at coarse offset (X, Y).
float galerkin_entry(const Patch& patch, int X, int Y) {
  float sum = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = 2 + 2 * X + dx, v = 2 + 2 * Y + dy;
      if (u < 0 || v < 0 || u > 4 || v > 4) continue;
      sum += transfer_weight(dx, dy) * patch[static_cast<size_t>(v)][static_cast<size_t>(u)];
    }
  }
  return sum;
}

StencilGrid coarser(const StencilGrid& fine) {
  StencilGrid coarse(fine.width / 2 + 1, fine.height / 2 + 1);
  for_rows(coarse, 0, 1, [&](int y) {
    for (int x = 0; x < coarse.width; ++x) {
      const Patch patch = restricted_rows(fine, 2 * x, 2 * y);
      const Index i = coarse.at(x, y);
      coarse.diagonal[i] = galerkin_entry(patch, 0, 0);
      coarse.right[i] = galerkin_entry(patch, 1, 0);
      coarse.down[i] = galerkin_entry(patch, 0, 1);
      coarse.down_right[i] = galerkin_entry(patch, 1, 1);
      coarse.down_left[i] = galerkin_entry(patch, -1, 1);
    }
  });
  return coarse;
}

/// Coarse right-hand side: P' times the fine residual.
void restrict_to(const StencilGrid& fine, const VectorXf& residual, const StencilGrid& coarse, VectorXf& r) {
  for_rows(coarse, 0, 1, [&](int y) {
    for (int x = 0; x < coarse.width; ++x) {
      float sum = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        const int v = 2 * y + dy;
        if (v < 0 || v >= fine.height) continue;
        for (int dx = -1; dx <= 1; ++dx) {
          const int u = 2 * x + dx;
          if (u >= 0 && u < fine.width) sum += transfer_weight(dx, dy) * residual[fine.at(u, v)];
        }
      }
      r[coarse.at(x, y)] = coarse.diagonal[coarse.at(x, y)] == 0.0f ? 0.0f : sum;
    }
  });
}

/// x += P times the coarse correction, inside the mask.
void prolong_add(const StencilGrid& coarse, const VectorXf& correction, const StencilGrid& fine,
                 VectorXf& x) {
  for_rows(fine, 0, 1, [&](int v) {
    for (int u = 0; u < fine.width; ++u) {
      const Index i = fine.at(u, v), c = coarse.at(u / 2, v / 2);
      if (fine.diagonal[i] == 0.0f) continue;
      const Index dx = u % 2, dy = (v % 2) * coarse.stride();
      x[i] += 0.25f * (correction[c] + correction[c + dx] + correction[c + dy] + correction[c + dx + dy]);
    }
  });
}

}  // namespace

StencilGrid::StencilGrid(int width_px, int height_px) : width(width_px), height(height_px) {
  for (VectorXf* part : {&diagonal, &right, &down, &down_right, &down_left}) *part = VectorXf::Zero(size());
}

void StencilGrid::multiply(const VectorXf& x, VectorXf& y) const {
  y.resize(size());
  y.head(stride()).setZero();
  y.tail(stride()).setZero();
  for_rows(*this, 0, 1, [&](int row) {
    y[at(-1, row)] = y[at(width, row)] = 0;
    multiply_row(*this, x, row, y);
  });
}

bool Multigrid::setup(StencilGrid finest) {
  levels_.clear();
  levels_.emplace_back();
  levels_.back().A = std::move(finest);
  while (levels_.back().A.size() > kCoarsestCells) {
    StencilGrid next = coarser(levels_.back().A);
    levels_.emplace_back();
    levels_.back().A = std::move(next);
  }
  for (Level& level : levels_) {
    if (!factorize_rows(level)) return false;
  }
  return factorize_coarsest();
}

bool Multigrid::factorize_rows(Level& level) {
  const StencilGrid& A = level.A;
  std::vector<unsigned char> sound(static_cast<size_t>(A.height), 1);
  level.x = level.r = level.residual = level.inverse_pivot = level.multiplier = VectorXf::Zero(A.size());
  for_rows(A, 0, 1, [&](int y) {
    for (Index i = A.at(0, y); i < A.at(A.width, y); ++i) {
      const float pivot = A.diagonal[i] - A.right[i - 1] * level.multiplier[i - 1];
      level.inverse_pivot[i] = pivot > 0.0f ? 1.0f / pivot : 0.0f;
      level.multiplier[i] = A.right[i] * level.inverse_pivot[i];
      if (A.diagonal[i] != 0.0f && !(pivot > 0.0f)) sound[static_cast<size_t>(y)] = 0;
    }
  });
  return std::all_of(sound.begin(), sound.end(), [](unsigned char each) { return each != 0; });
}

bool Multigrid::factorize_coarsest() {
  const StencilGrid& A = levels_.back().A;
  coarsest_cells_.clear();
  for (Index i = 0; i < A.size(); ++i)
    if (A.diagonal[i] > 0.0f) coarsest_cells_.push_back(i);
  const auto count = static_cast<Index>(coarsest_cells_.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count, count);
  std::vector<Index> number(static_cast<size_t>(A.size()), -1);
  for (Index k = 0; k < count; ++k) number[static_cast<size_t>(coarsest_cells_[static_cast<size_t>(k)])] = k;
  for (Index k = 0; k < count; ++k) {
    const Index i = coarsest_cells_[static_cast<size_t>(k)];
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Index other = number[static_cast<size_t>(i + dy * A.stride() + dx)];
        if (other >= 0) dense(k, other) = static_cast<double>(entry(A, i, dx, dy));
      }
    }
  }
  coarsest_.compute(dense);
  return coarsest_.info() == Eigen::Success;
}

void Multigrid::apply(const VectorXf& r, VectorXf& z) {
  levels_.front().r = r;
  cycle(0);
  z = levels_.front().x;
}

void Multigrid::cycle(size_t number) {
  if (number + 1 == levels_.size()) {
    solve_coarsest();
    return;
  }
  Level& level = levels_[number];
  Level& next = levels_[number + 1];
  const StencilGrid& A = level.A;
  const auto solve_row = [&](int y) {
    VectorXf& g = level.residual;  // free until the residual is taken
    for (Index i = A.at(0, y); i < A.at(A.width, y); ++i) g[i] = level.r[i] - from_other_rows(A, level.x, i);
    for (Index i = A.at(1, y); i < A.at(A.width, y); ++i) g[i] -= level.multiplier[i - 1] * g[i - 1];
    for (Index i = A.at(A.width - 1, y); i >= A.at(0, y); --i)
      level.x[i] = g[i] * level.inverse_pivot[i] - level.multiplier[i] * level.x[i + 1];
  };
  level.x.setZero();
  for_rows(A, 0, 2, solve_row);
  for_rows(A, 1, 2, solve_row);
  A.multiply(level.x, level.residual);
  level.residual = level.r - level.residual;
  restrict_to(A, level.residual, next.A, next.r);
  cycle(number + 1);
  prolong_add(next.A, next.x, A, level.x);
  for_rows(A, 1, 2, solve_row);
  for_rows(A, 0, 2, solve_row);
}

void Multigrid::solve_coarsest() {
  Level& level = levels_.back();
  Eigen::VectorXd r(static_cast<Index>(coarsest_cells_.size()));
  for (Index k = 0; k < r.size(); ++k)
    r[k] = static_cast<double>(level.r[coarsest_cells_[static_cast<size_t>(k)]]);
  const Eigen::VectorXd x = coarsest_.solve(r);
  level.x.setZero();
  for (Index k = 0; k < r.size(); ++k)
    level.x[coarsest_cells_[static_cast<size_t>(k)]] = static_cast<float>(x[k]);
}

}  // namespace rakelight
