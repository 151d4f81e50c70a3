// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/solver/line_solver.h"

#include <algorithm>
#include <array>

namespace rakelight {
namespace {

using Eigen::Index;

/// Calls body with the number of rows left as a compile-time constant, so that its loops over rows unroll.
template <class Body>
void with_row_count(int rows, const Body& body) {
  switch (std::min(rows, LineSolver::kRowsAtOnce)) {
    case 4:
      return body(std::integral_constant<size_t, 4>());
    case 3:
      return body(std::integral_constant<size_t, 3>());
    case 2:
      return body(std::integral_constant<size_t, 2>());
    case 1:
      return body(std::integral_constant<size_t, 1>());
    default:
      return;
  }
}

int rows_left(const StencilGrid& A, int first, int step) { return (A.height - first + step - 1) / step; }

/// Where few fine pixels hang on more coarse ones, as at a frayed rim, the coarse matrix is singular though the fine one is not,
/// and rounding puts its pivots on either side of zero. A pivot below the first share of its diagonal is raised to it, which
/// keeps the solve positive definite; only one below minus the second speaks of a matrix that is not.
constexpr float kLeastPivot = 1e-5f, kRounding = 1e-3f;

/// @return whether no pivot is clearly negative
template <size_t kRows>
bool factorize_rows(const StencilGrid& A, int first, float* inverse_pivot, float* multiplier) {
  std::array<float, kRows> coupling{}, before{};
  float least = 1;
  for (int i = 0; i < A.width; ++i) {
    for (size_t k = 0; k < kRows; ++k) {
      const Index at = A.at(i, first + static_cast<int>(k));
      const float diagonal = A.diagonal[at], pivot = diagonal - coupling[k] * before[k];
      if (diagonal != 0.0f) least = std::min(least, pivot + kRounding * diagonal);
      inverse_pivot[at] = diagonal > 0.0f ? 1.0f / std::max(pivot, kLeastPivot * diagonal) : 0.0f;
      coupling[k] = A.right[at];
      multiplier[at] = before[k] = coupling[k] * inverse_pivot[at];
    }
  }
  return least > 0.0f;
}

template <size_t kRows>
void solve_rows(const StencilGrid& A, int first, int step, const float* inverse_pivot,
                const float* multiplier, float* x) {
  const Index row = step * A.stride(), begin = A.at(0, first);
  const float *ip = inverse_pivot + begin, *m = multiplier + begin;
  float* v = x + begin;
  std::array<float, kRows> last{};
  for (Index i = 0; i < A.width; ++i) {
    for (size_t k = 0; k < kRows; ++k) {
      const Index at = static_cast<Index>(k) * row + i;
      v[at] = last[k] = v[at] - m[at - 1] * last[k];  // the multiplier in the border is 0
    }
  }
  last = {};
  for (Index i = A.width - 1; i >= 0; --i) {
    for (size_t k = 0; k < kRows; ++k) {
      const Index at = static_cast<Index>(k) * row + i;
      v[at] = last[k] = v[at] * ip[at] - m[at] * last[k];
    }
  }
}

}  // namespace

bool LineSolver::factorize(const StencilGrid& A) {
  inverse_pivot_ = multiplier_ = Eigen::VectorXf::Zero(A.size());
  std::vector<unsigned char> sound(static_cast<size_t>(A.height), 1);
  for_rows(A, 0, kRowsAtOnce, [&](int first) {
    with_row_count(rows_left(A, first, 1), [&](auto rows) {
      sound[static_cast<size_t>(first)] =
          factorize_rows<decltype(rows)::value>(A, first, inverse_pivot_.data(), multiplier_.data());
    });
  });
  return std::all_of(sound.begin(), sound.end(), [](unsigned char each) { return each != 0; });
}

void LineSolver::solve(const StencilGrid& A, int first, int step, Eigen::VectorXf& x) const {
  with_row_count(rows_left(A, first, step), [&](auto rows) {
    solve_rows<decltype(rows)::value>(A, first, step, inverse_pivot_.data(), multiplier_.data(), x.data());
  });
}

}  // namespace rakelight
