// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Row operations of the multigrid solver (refine/solver/multigrid.h). All pointers are to a row's first pixel; rows have
// zeros on the left (one) and on the right (up to the next multiple of kRowAlign, and one more), which stay zeros.
#pragma once

#include <cstddef>

namespace rakelight::kernels {

constexpr int kRowAlign = 32;  // two of the longest vectors: rows are read in pairs of pixels, too

/// One row of a symmetric 9-point stencil, and through `stride` the rows above and below.
struct StencilRow {
  const float *diagonal, *right, *down, *down_right, *down_left;
  std::ptrdiff_t stride;
  int width;
};

/// y = A x in this row. @return x . y of the row
float multiply_row(const StencilRow& A, const float* x, float* y);

/// The same, and b . x of the row.
struct RowProducts {
  float xAx, bx;
};
RowProducts multiply_row(const StencilRow& A, const float* x, const float* b, float* y);

/// g = r - what the rows above and below add to A x; r null: zeros.
void subtract_other_rows(const StencilRow& A, const float* x, const float* r, float* g);

/// Coarse right-hand side: 1/2, 1, 1/2 of the fine residual at 2X - 1, 2X, 2X + 1; 0 where the coarse diagonal is 0.
void restrict_row(const float* residual, const float* coarse_diagonal, int coarse_width, float* r);

/// x += the coarse correction, interpolated along the row, where the fine diagonal is not 0.
void prolong_row(const float* correction, const float* fine_diagonal, int fine_width, float* x);

/// Rows with three entries a pixel: to the left, same and right pixel of the row it couples to.
struct BandRow {
  float *left, *same, *right;
};

/// What the rows 2Y - 1, 2Y, 2Y + 1 of a stencil become under vertical interpolation: the coarse row's couplings to itself
/// (symmetric: `left` is not filled) and to the coarse row below. `zeros` stands for rows outside.
void collapse_rows(const StencilRow& above, const StencilRow& middle, const StencilRow& below,
                   const BandRow& itself, const BandRow& to_next);

/// Where a row of a stencil is written.
struct EntryRow {
  float *diagonal, *right, *down, *down_right, *down_left;
};

/// The same along the row: a row of the coarse stencil.
void collapse_along(const BandRow& itself, const BandRow& to_next, int coarse_width, const EntryRow& coarse);

/// Sum of a b over a row.
float dot_row(const float* a, const float* b, int width);

/// r -= length q
void shorten_row(const float* q, float length, int width, float* r);

/// One step of conjugate gradients' vectors (refine/solver/multigrid_depth_solver.cpp), after a step of length `last`:
/// x += last p, p = z + share p, q = Az + share q, r -= length q.
struct GradientRow {
  const float *z, *Az;
  float *x, *p, *q, *r;
};
void step_row(const GradientRow& row, float last, float share, float length, int width);

/// The tridiagonal matrices of that many rows are factorised and solved side by side, because each step along a row waits for
/// the one before it.
constexpr int kLines = 8;
constexpr int kLineFactors = 2 * kLines;  ///< numbers a column

/// L D L' of the rows' tridiagonal matrices. Rows are readable up to a multiple of 4 columns, zeros past the last.
/// @param factors  kLineFactors a column, columns rounded up to 4
/// @return 1 at most, not positive when a pivot is clearly negative
float factorize_lines(const float* const (&diagonal)[kLines], const float* const (&right)[kLines], int width,
                      float* factors);

/// Solves for the rows, which may be the right-hand sides themselves.
/// @param scratch kLines numbers a column, columns rounded up to 4
void solve_lines(const float* factors, int width, const float* const (&right_sides)[kLines],
                 float* const (&rows)[kLines], float* scratch);

}  // namespace rakelight::kernels
