// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/stencil_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/stencil_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {
HWY_INLINE V load(const float* p) { return hn::LoadU(D(), p); }

/// The couplings of pixel i to the rows above and below, times x.
HWY_INLINE V other_rows(const StencilRow& A, const float* x, int i) {
  const std::ptrdiff_t s = A.stride, up = i - s, down = i + s;
  V sum = hn::Mul(load(A.down + i), load(x + down));
  sum = hn::MulAdd(load(A.down_right + i), load(x + down + 1), sum);
  sum = hn::MulAdd(load(A.down_left + i), load(x + down - 1), sum);
  sum = hn::MulAdd(load(A.down + up), load(x + up), sum);
  sum = hn::MulAdd(load(A.down_right + up - 1), load(x + up - 1), sum);
  return hn::MulAdd(load(A.down_left + up + 1), load(x + up + 1), sum);
}

template <class Visit>
HWY_INLINE float multiply_row_and(const StencilRow& A, const float* x, float* y, const Visit& visit) {
  const D d;
  V dot = hn::Zero(d);
  for (int i = 0; i < A.width; i += lanes()) {
    const V here = load(x + i);
    V sum = hn::MulAdd(load(A.diagonal + i), here, other_rows(A, x, i));
    sum = hn::MulAdd(load(A.right + i), load(x + i + 1), sum);
    sum = hn::MulAdd(load(A.right + i - 1), load(x + i - 1), sum);
    hn::StoreU(sum, d, y + i);
    dot = hn::MulAdd(sum, here, dot);
    visit(i, here);
  }
  return hn::GetLane(hn::SumOfLanes(d, dot));
}

float multiply_row(const StencilRow& A, const float* x, float* y) {
  return multiply_row_and(A, x, y, [](int, V) {});
}

RowProducts multiply_row_and_dot(const StencilRow& A, const float* x, const float* b, float* y) {
  V bx = hn::Zero(D());
  const float xAx = multiply_row_and(A, x, y, [&](int i, V here) { bx = hn::MulAdd(load(b + i), here, bx); });
  return {xAx, hn::GetLane(hn::SumOfLanes(D(), bx))};
}

void subtract_other_rows(const StencilRow& A, const float* x, const float* r, float* g) {
  const D d;
  for (int i = 0; i < A.width; i += lanes()) {
    const V right_side = r == nullptr ? hn::Zero(d) : load(r + i);
    hn::StoreU(hn::Sub(right_side, other_rows(A, x, i)), d, g + i);
  }
}

/// Values at 2X, 2X + 1 and 2X - 1 of a vector of coarse pixels.
struct Around {
  V even, right, left;

  explicit Around(const float* fine) {
    V skipped;
    hn::LoadInterleaved2(D(), fine, even, right);
    hn::LoadInterleaved2(D(), fine - 2, skipped, left);
  }
};

void restrict_row(const float* residual, const float* coarse_diagonal, int coarse_width, float* r) {
  const D d;
  const V half = hn::Set(d, 0.5f), none = hn::Zero(d);
  for (int X = 0; X < coarse_width; X += lanes()) {
    const Around at(residual + 2 * X);
    const V sum = hn::MulAdd(half, hn::Add(at.left, at.right), at.even);
    hn::StoreU(hn::IfThenElseZero(hn::Ne(load(coarse_diagonal + X), none), sum), d, r + X);
  }
}

void prolong_row(const float* correction, const float* fine_diagonal, int fine_width, float* x) {
  const D d;
  const V half = hn::Set(d, 0.5f), none = hn::Zero(d);
  for (int u = 0; u < fine_width; u += 2 * lanes()) {
    const V here = load(correction + u / 2),
            between = hn::Mul(half, hn::Add(here, load(correction + u / 2 + 1)));
    V even, odd, even_diagonal, odd_diagonal;
    hn::LoadInterleaved2(d, x + u, even, odd);
    hn::LoadInterleaved2(d, fine_diagonal + u, even_diagonal, odd_diagonal);
    even = hn::Add(even, hn::IfThenElseZero(hn::Ne(even_diagonal, none), here));
    odd = hn::Add(odd, hn::IfThenElseZero(hn::Ne(odd_diagonal, none), between));
    hn::StoreInterleaved2(even, odd, d, x + u);
  }
}

void collapse_rows(const StencilRow& above, const StencilRow& middle, const StencilRow& below,
                   const BandRow& itself, const BandRow& to_next) {
  const D d;
  const V half = hn::Set(d, 0.5f), quarter = hn::Set(d, 0.25f);
  for (int x = 0; x < middle.width; x += lanes()) {
    const auto with_outer = [&](const float* a, const float* m, const float* b) {
      return hn::MulAdd(quarter, hn::Add(load(a + x), load(b + x)), load(m + x));
    };
    const auto halves = [&](const float* a, const float* b) {
      return hn::Mul(half, hn::Add(load(a + x), load(b + x)));
    };
    const V same = with_outer(above.diagonal, middle.diagonal, below.diagonal);
    hn::StoreU(hn::Add(same, hn::Add(load(above.down + x), load(middle.down + x))), d, itself.same + x);
    const V slanted = hn::Add(halves(above.down_right, above.down_left + 1),
                              halves(middle.down_right, middle.down_left + 1));
    hn::StoreU(hn::Add(with_outer(above.right, middle.right, below.right), slanted), d, itself.right + x);
    hn::StoreU(hn::MulAdd(quarter, load(below.diagonal + x), halves(middle.down, below.down)), d,
               to_next.same + x);
    hn::StoreU(hn::MulAdd(quarter, load(below.right + x), halves(middle.down_right, below.down_right)), d,
               to_next.right + x);
    hn::StoreU(hn::MulAdd(quarter, load(below.right + x - 1), halves(middle.down_left, below.down_left)), d,
               to_next.left + x);
  }
}

void collapse_along(const BandRow& itself, const BandRow& to_next, int coarse_width, const EntryRow& coarse) {
  const D d;
  const V half = hn::Set(d, 0.5f), quarter = hn::Set(d, 0.25f);
  for (int X = 0; X < coarse_width; X += lanes()) {
    const auto inside = hn::FirstN(d, static_cast<size_t>(coarse_width - X));
    const auto store = [&](V value, float* to) { hn::StoreU(hn::IfThenElseZero(inside, value), d, to + X); };
    const auto with_outer = [&](const Around& v) {
      return hn::MulAdd(quarter, hn::Add(v.left, v.right), v.even);
    };
    const Around same(itself.same + 2 * X), right(itself.right + 2 * X);
    store(hn::Add(with_outer(same), hn::Add(right.left, right.even)), coarse.diagonal);
    store(hn::MulAdd(quarter, same.right, hn::Mul(half, hn::Add(right.even, right.right))), coarse.right);

    const Around down(to_next.same + 2 * X), down_right(to_next.right + 2 * X),
        down_left(to_next.left + 2 * X);
    const V slanted =
        hn::Add(hn::Add(down_right.left, down_right.even), hn::Add(down_left.even, down_left.right));
    store(hn::MulAdd(half, slanted, with_outer(down)), coarse.down);
    store(hn::MulAdd(quarter, down.right, hn::Mul(half, hn::Add(down_right.even, down_right.right))),
          coarse.down_right);
    store(hn::MulAdd(quarter, down.left, hn::Mul(half, hn::Add(down_left.even, down_left.left))),
          coarse.down_left);
  }
}

float dot_row(const float* a, const float* b, int width) {
  const D d;
  V sum = hn::Zero(d);
  for (int i = 0; i < width; i += lanes()) sum = hn::MulAdd(load(a + i), load(b + i), sum);
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

void shorten_row(const float* q, float length, int width, float* r) {
  const D d;
  const V l = hn::Set(d, length);
  for (int i = 0; i < width; i += lanes()) hn::StoreU(hn::NegMulAdd(l, load(q + i), load(r + i)), d, r + i);
}

void step_row(const GradientRow& row, float last, float share, float length, int width) {
  const D d;
  const V before = hn::Set(d, last), s = hn::Set(d, share), l = hn::Set(d, length);
  for (int i = 0; i < width; i += lanes()) {
    const V p = load(row.p + i), q = hn::MulAdd(s, load(row.q + i), load(row.Az + i));
    hn::StoreU(hn::MulAdd(before, p, load(row.x + i)), d, row.x + i);
    hn::StoreU(hn::MulAdd(s, p, load(row.z + i)), d, row.p + i);
    hn::StoreU(q, d, row.q + i);
    hn::StoreU(hn::NegMulAdd(l, q, load(row.r + i)), d, row.r + i);
  }
}

/// Lines side by side: a vector holds one column of kAcross rows.
using Across = hn::CappedTag<float, 4>;
using VA = hn::Vec<Across>;
constexpr int kAcross = HWY_TARGET == HWY_SCALAR ? 1 : 4;
constexpr int kVectors = kLines / kAcross;

HWY_INLINE void transpose(VA (&v)[kAcross]) {
#if HWY_TARGET == HWY_SCALAR
  (void)v;
#else
  const Across d;
  const hn::RepartitionToWide<Across> pairs;
  const auto both = [&](VA a) { return hn::BitCast(pairs, a); };
  const VA low01 = hn::InterleaveLower(d, v[0], v[1]), high01 = hn::InterleaveUpper(d, v[0], v[1]),
           low23 = hn::InterleaveLower(d, v[2], v[3]), high23 = hn::InterleaveUpper(d, v[2], v[3]);
  v[0] = hn::BitCast(d, hn::InterleaveLower(pairs, both(low01), both(low23)));
  v[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, both(low01), both(low23)));
  v[2] = hn::BitCast(d, hn::InterleaveLower(pairs, both(high01), both(high23)));
  v[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, both(high01), both(high23)));
#endif
}

/// kAcross columns of kLines rows.
struct Columns {
  VA at[kVectors][kAcross];  ///< [rows][column]

  HWY_INLINE void load(const float* const (&rows)[kLines], int column) {
    for (int part = 0; part < kVectors; ++part) {
      for (int k = 0; k < kAcross; ++k) at[part][k] = hn::LoadU(Across(), rows[kAcross * part + k] + column);
      transpose(at[part]);
    }
  }

  HWY_INLINE void store(float* const (&rows)[kLines], int column) {
    for (int part = 0; part < kVectors; ++part) {
      transpose(at[part]);
      for (int k = 0; k < kAcross; ++k) hn::StoreU(at[part][k], Across(), rows[kAcross * part + k] + column);
    }
  }
};

/// Where few fine pixels hang on more coarse ones, as at a frayed rim, the coarse matrix is singular though the fine one is not,
/// and rounding puts its pivots on either side of zero. A pivot below the first share of its diagonal is raised to it, which
/// keeps the solve positive definite; only one below minus the second speaks of a matrix that is not.
constexpr float kLeastPivot = 1e-5f, kRounding = 1e-3f;

float factorize_lines(const float* const (&diagonal)[kLines], const float* const (&right)[kLines], int width,
                      float* factors) {
  const Across d;
  const VA none = hn::Zero(d), one = hn::Set(d, 1.0f);
  const VA rounding = hn::Set(d, kRounding), raised = hn::Set(d, kLeastPivot);
  VA least = one, coupling[kVectors], multiplier[kVectors];
  for (int part = 0; part < kVectors; ++part) coupling[part] = multiplier[part] = none;
  for (int column = 0; column < width; column += kAcross) {
    Columns center, next;
    center.load(diagonal, column);
    next.load(right, column);
    for (int k = 0; k < kAcross; ++k) {
      float* to = factors + (column + k) * kLineFactors;
      for (int part = 0; part < kVectors; ++part) {
        const VA entry = center.at[part][k];
        const VA pivot = hn::NegMulAdd(coupling[part], multiplier[part], entry);
        const VA seen = hn::IfThenElse(hn::Ne(entry, none), hn::MulAdd(rounding, entry, pivot), one);
        least = hn::Min(least, seen);
        const auto sound = hn::Gt(entry, none);
        const VA safe = hn::IfThenElse(sound, hn::Max(pivot, hn::Mul(raised, entry)), one);
        const VA inverse = hn::IfThenElseZero(sound, hn::Div(one, safe));
        coupling[part] = next.at[part][k];
        multiplier[part] = hn::Mul(coupling[part], inverse);
        hn::StoreU(multiplier[part], d, to + kAcross * part);
        hn::StoreU(inverse, d, to + kLines + kAcross * part);
      }
    }
  }
  return hn::GetLane(hn::MinOfLanes(d, least));
}

void solve_lines(const float* factors, int width, const float* const (&right_sides)[kLines],
                 float* const (&rows)[kLines], float* scratch) {
  const Across d;
  const int columns = (width + kAcross - 1) / kAcross * kAcross;
  VA last[kVectors], multiplier[kVectors];
  for (int part = 0; part < kVectors; ++part) last[part] = multiplier[part] = hn::Zero(d);
  for (int column = 0; column < columns; column += kAcross) {
    Columns r;
    r.load(right_sides, column);
    for (int k = 0; k < kAcross; ++k) {
      for (int part = 0; part < kVectors; ++part) {
        last[part] = hn::NegMulAdd(multiplier[part], last[part], r.at[part][k]);
        multiplier[part] = hn::LoadU(d, factors + (column + k) * kLineFactors + kAcross * part);
        hn::StoreU(last[part], d, scratch + (column + k) * kLines + kAcross * part);
      }
    }
  }
  for (VA& each : last) each = hn::Zero(d);
  for (int column = columns - kAcross; column >= 0; column -= kAcross) {
    Columns x;
    for (int k = kAcross - 1; k >= 0; --k) {
      const float* factor = factors + (column + k) * kLineFactors;
      for (int part = 0; part < kVectors; ++part) {
        const VA y = hn::LoadU(d, scratch + (column + k) * kLines + kAcross * part);
        const VA scaled = hn::Mul(y, hn::LoadU(d, factor + kLines + kAcross * part));
        x.at[part][k] = last[part] = hn::NegMulAdd(hn::LoadU(d, factor + kAcross * part), last[part], scaled);
      }
    }
    x.store(rows, column);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(multiply_row);
HWY_EXPORT(multiply_row_and_dot);
HWY_EXPORT(subtract_other_rows);
HWY_EXPORT(restrict_row);
HWY_EXPORT(prolong_row);
HWY_EXPORT(collapse_rows);
HWY_EXPORT(collapse_along);
HWY_EXPORT(dot_row);
HWY_EXPORT(shorten_row);
HWY_EXPORT(step_row);
HWY_EXPORT(factorize_lines);
HWY_EXPORT(solve_lines);

float multiply_row(const StencilRow& A, const float* x, float* y) {
  return HWY_DYNAMIC_DISPATCH(multiply_row)(A, x, y);
}

RowProducts multiply_row(const StencilRow& A, const float* x, const float* b, float* y) {
  return HWY_DYNAMIC_DISPATCH(multiply_row_and_dot)(A, x, b, y);
}

void subtract_other_rows(const StencilRow& A, const float* x, const float* r, float* g) {
  HWY_DYNAMIC_DISPATCH(subtract_other_rows)(A, x, r, g);
}

void restrict_row(const float* residual, const float* coarse_diagonal, int coarse_width, float* r) {
  HWY_DYNAMIC_DISPATCH(restrict_row)(residual, coarse_diagonal, coarse_width, r);
}

void prolong_row(const float* correction, const float* fine_diagonal, int fine_width, float* x) {
  HWY_DYNAMIC_DISPATCH(prolong_row)(correction, fine_diagonal, fine_width, x);
}

void collapse_rows(const StencilRow& above, const StencilRow& middle, const StencilRow& below,
                   const BandRow& itself, const BandRow& to_next) {
  HWY_DYNAMIC_DISPATCH(collapse_rows)(above, middle, below, itself, to_next);
}

void collapse_along(const BandRow& itself, const BandRow& to_next, int coarse_width, const EntryRow& coarse) {
  HWY_DYNAMIC_DISPATCH(collapse_along)(itself, to_next, coarse_width, coarse);
}

float dot_row(const float* a, const float* b, int width) {
  return HWY_DYNAMIC_DISPATCH(dot_row)(a, b, width);
}

void shorten_row(const float* q, float length, int width, float* r) {
  HWY_DYNAMIC_DISPATCH(shorten_row)(q, length, width, r);
}

void step_row(const GradientRow& row, float last, float share, float length, int width) {
  HWY_DYNAMIC_DISPATCH(step_row)(row, last, share, length, width);
}

float factorize_lines(const float* const (&diagonal)[kLines], const float* const (&right)[kLines], int width,
                      float* factors) {
  return HWY_DYNAMIC_DISPATCH(factorize_lines)(diagonal, right, width, factors);
}

void solve_lines(const float* factors, int width, const float* const (&right_sides)[kLines],
                 float* const (&rows)[kLines], float* scratch) {
  HWY_DYNAMIC_DISPATCH(solve_lines)(factors, width, right_sides, rows, scratch);
}

}  // namespace rakelight::kernels
#endif
