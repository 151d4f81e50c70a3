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

float multiply_row(const StencilRow& A, const float* x, float* y) {
  const D d;
  V dot = hn::Zero(d);
  for (int i = 0; i < A.width; i += lanes()) {
    const V here = load(x + i);
    V sum = hn::MulAdd(load(A.diagonal + i), here, other_rows(A, x, i));
    sum = hn::MulAdd(load(A.right + i), load(x + i + 1), sum);
    sum = hn::MulAdd(load(A.right + i - 1), load(x + i - 1), sum);
    hn::StoreU(sum, d, y + i);
    dot = hn::MulAdd(sum, here, dot);
  }
  return hn::GetLane(hn::SumOfLanes(d, dot));
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

void collapse_along(const BandRow& itself, const BandRow& to_next, const CoarseRow& coarse) {
  const D d;
  const V half = hn::Set(d, 0.5f), quarter = hn::Set(d, 0.25f);
  for (int X = 0; X < coarse.width; X += lanes()) {
    const auto inside = hn::FirstN(d, static_cast<size_t>(coarse.width - X));
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

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(multiply_row);
HWY_EXPORT(subtract_other_rows);
HWY_EXPORT(restrict_row);
HWY_EXPORT(prolong_row);
HWY_EXPORT(collapse_rows);
HWY_EXPORT(collapse_along);

float multiply_row(const StencilRow& A, const float* x, float* y) {
  return HWY_DYNAMIC_DISPATCH(multiply_row)(A, x, y);
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

void collapse_along(const BandRow& itself, const BandRow& to_next, const CoarseRow& coarse) {
  HWY_DYNAMIC_DISPATCH(collapse_along)(itself, to_next, coarse);
}

}  // namespace rakelight::kernels
#endif
