// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/corner_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/corner_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// The existing corners' bits of a vector of pixels.
HWY_INLINE hn::Vec<Ints> load_bits(const unsigned char* present, int i) {
  return hn::PromoteTo(Ints(), hn::LoadU(Bytes(), present + i));
}

HWY_INLINE hn::Mask<D> has_corner(hn::Vec<Ints> bits, int k) {
  const Ints ints;
  return hn::RebindMask(D(), hn::TestBit(bits, hn::Set(ints, 1 << k)));
}

/// Gradients of zeta at a vector of pixels towards each side.
struct Gradients {
  V x[2], y[2];  ///< of differences to the right and left, down and up

  Gradients(const CornerRun& run, int i) {
    const D d;
    const V middle = hn::LoadU(d, run.here + i);
    x[0] = hn::Sub(hn::LoadU(d, run.here + i + 1), middle);
    x[1] = hn::Sub(middle, hn::LoadU(d, run.here + i - 1));
    y[0] = hn::Sub(hn::LoadU(d, run.below + i), middle);
    y[1] = hn::Sub(middle, hn::LoadU(d, run.above + i));
  }
};

/// The camera's share in the normals of Eq. (5) at a vector of pixels.
struct Frame {
  V fx, fy, x, y;

  Frame(const CornerRun& run, int i) {
    const D d;
    fx = hn::Set(d, run.fx);
    fy = hn::Set(d, run.fy);
    x = hn::Add(hn::Set(d, run.x), hn::Iota(d, static_cast<float>(i)));
    y = hn::Set(d, run.y);
  }

  HWY_INLINE Vector3 raw(V gx, V gy) const {
    const V minus_one = hn::Set(D(), -1.0f);
    return {hn::Mul(fx, gx), hn::Mul(fy, gy), hn::NegMulAdd(y, gy, hn::NegMulAdd(x, gx, minus_one))};
  }
};

HWY_INLINE V inverse_length(const Vector3& v) { return hn::Div(hn::Set(D(), 1.0f), hn::Sqrt(dot(v, v))); }

/// e(n) = n' G n - 2 h' n + e0 of a vector of pixels as a form of the gradient. The raw normal is linear in q = (gx, gy, 1),
/// J' = M q, so with H = M' G M and k = M' h, the same at a pixel's four corners,
///
///     e = q' H q / d^2 - 2 k' q / d + e0,   d = |J'|
struct GradientForm {
  V xx, xy, xz, yy, yz, zz;  ///< H
  Vector3 k;
  V e0;

  GradientForm(const TensorRun& run, const Frame& at, int i) {
    const auto part = [&](int number) { return hn::LoadU(D(), run.part[number] + i); };
    const V Gxz = part(2), Gyz = part(4), hz = part(8);
    zz = part(5);
    xz = hn::NegMulAdd(at.fx, Gxz, hn::Mul(at.x, zz));
    yz = hn::NegMulAdd(at.fy, Gyz, hn::Mul(at.y, zz));
    const V left = hn::NegMulAdd(at.x, Gxz, hn::Mul(at.fx, part(0))),
            middle = hn::NegMulAdd(at.y, Gxz, hn::Mul(at.fy, part(1))),
            right = hn::NegMulAdd(at.y, Gyz, hn::Mul(at.fy, part(3)));
    xx = hn::MulAdd(at.x, xz, hn::Mul(at.fx, left));
    xy = hn::MulAdd(at.x, yz, hn::Mul(at.fx, middle));
    yy = hn::MulAdd(at.y, yz, hn::Mul(at.fy, right));
    k = {hn::NegMulAdd(at.x, hz, hn::Mul(at.fx, part(6))), hn::NegMulAdd(at.y, hz, hn::Mul(at.fy, part(7))),
         hn::Neg(hz)};
    e0 = part(9);
  }
};

/// The form at one corner.
struct CornerEnergy {
  Vector3 raw;                                 ///< J'
  V inverse_d, inverse_square, kq, Hx, Hy, s;  ///< 1 / d, 1 / d^2, k' q, the gradient's part of H q, q' H q
  V e;

  HWY_INLINE CornerEnergy(const GradientForm& form, const Frame& frame, V gx, V gy) {
    raw = frame.raw(gx, gy);
    inverse_d = inverse_length(raw);
    inverse_square = hn::Mul(inverse_d, inverse_d);
    Hx = hn::MulAdd(form.xx, gx, hn::MulAdd(form.xy, gy, form.xz));
    Hy = hn::MulAdd(form.xy, gx, hn::MulAdd(form.yy, gy, form.yz));
    const V Hz = hn::MulAdd(form.xz, gx, hn::MulAdd(form.yz, gy, form.zz));
    s = hn::MulAdd(Hx, gx, hn::MulAdd(Hy, gy, Hz));
    kq = hn::MulAdd(form.k.x, gx, hn::MulAdd(form.k.y, gy, form.k.z));
    const V twice = hn::Add(inverse_d, inverse_d);
    e = hn::MulAdd(s, inverse_square, hn::NegMulAdd(twice, kq, form.e0));
  }
};

/// Calls store(i, e): e the energies max(0, e) of the existing corners of the pixels i, i + 1, ..., 0 of the others.
template <class Store>
HWY_INLINE void for_corner_energies(const CornerRun& run, const TensorRun& tensors, const Store& store) {
  const D d;
  for (int i = 0; i < run.count; i += lanes()) {
    const Gradients g(run, i);
    const Frame frame(run, i);
    const GradientForm form(tensors, frame, i);
    const auto bits = load_bits(run.present, i);
    V e[4];
    for (int k = 0; k < 4; ++k) {
      const CornerEnergy corner(form, frame, g.x[k & 1], g.y[k >> 1]);
      e[k] = hn::IfThenElseZero(has_corner(bits, k), hn::Max(hn::Zero(d), corner.e));
    }
    store(i, e);
  }
}

void corner_energies(const CornerRun& run, const TensorRun& tensors, float* energies) {
  for_corner_energies(
      run, tensors, [&](int i, const V(&e)[4]) { store_interleaved<4>(e, run.count - i, energies + 4 * i); });
}

void corner_weights(const CornerRun& run, const TensorRun& tensors, const float* share, float half,
                    float* weights) {
  const D d;
  const V one = hn::Set(d, 1.0f), inverse_half = hn::Set(d, 1.0f / half);
  for_corner_energies(run, tensors, [&](int i, const V(&e)[4]) {
    const auto bits = load_bits(run.present, i);
    const V here = hn::LoadU(d, share + i);
    V w[4];
    for (int k = 0; k < 4; ++k) {
      const V weight = hn::Div(here, hn::Sqrt(hn::MulAdd(e[k], inverse_half, one)));
      w[k] = hn::IfThenElseZero(has_corner(bits, k), weight);
    }
    store_interleaved<4>(w, run.count - i, weights + 4 * i);
  });
}

float weighted_energy(const CornerRun& run, const TensorRun& tensors, const float* weights) {
  const D d;
  V sum = hn::Zero(d);
  for (int i = 0; i < run.count; i += lanes()) {
    const Gradients g(run, i);
    const Frame frame(run, i);
    const GradientForm form(tensors, frame, i);
    const auto inside = hn::FirstN(d, static_cast<size_t>(run.count - i));
    V w[4];
    hn::LoadInterleaved4(d, weights + 4 * i, w[0], w[1], w[2], w[3]);
    for (int k = 0; k < 4; ++k) {
      const CornerEnergy corner(form, frame, g.x[k & 1], g.y[k >> 1]);
      sum = hn::MulAdd(hn::IfThenElseZero(inside, w[k]), corner.e, sum);
    }
  }
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

/// With t = d n / d(gradient) the tangents (J - alpha J') / d, J = d J' / d(gradient):
///   t' G t = (J - alpha J')' G (J - alpha J') / d^2,   t' (h - G n) = (J - alpha J')' (h / d - G J' / d^2)
/// and J' G J, J' G J', J' h are entries of the form. alpha = J . J' / d^2 takes out what only lengthens the normal; the
/// fixed point keeps it (alpha = 0).
template <bool kTurning>
HWY_INLINE float corner_equations_as(const CornerRun& run, const TensorRun& tensors, const float* weights,
                                     const EquationRow& equations) {
  const D d;
  const V none = hn::Zero(d);
  V sum = none;
  for (int i = 0; i < run.count; i += lanes()) {
    const Gradients g(run, i);
    const Frame frame(run, i);
    const GradientForm form(tensors, frame, i);
    const auto inside = hn::FirstN(d, static_cast<size_t>(run.count - i));
    V w[4];
    hn::LoadInterleaved4(d, weights + 4 * i, w[0], w[1], w[2], w[3]);
    V xx[2] = {none, none}, yy[2] = {none, none}, bx[2] = {none, none}, by[2] = {none, none};
    for (int k = 0; k < 4; ++k) {
      const int left = k & 1, up = k >> 1;
      const CornerEnergy at(form, frame, g.x[left], g.y[up]);
      const V weight = hn::IfThenElseZero(inside, w[k]);
      sum = hn::MulAdd(weight, at.e, sum);
      const V by_square = hn::Mul(weight, at.inverse_square), by_length = hn::Mul(weight, at.inverse_d);
      V Px = at.Hx, Py = at.Hy, Qxx = form.xx, Qyy = form.yy, Qxy = form.xy, kx = form.k.x, ky = form.k.y;
      if constexpr (kTurning) {
        const V Jx = hn::NegMulAdd(frame.x, at.raw.z, hn::Mul(frame.fx, at.raw.x)),
                Jy = hn::NegMulAdd(frame.y, at.raw.z, hn::Mul(frame.fy, at.raw.y));
        const V alpha_x = hn::Mul(Jx, at.inverse_square), alpha_y = hn::Mul(Jy, at.inverse_square);
        Px = hn::NegMulAdd(alpha_x, at.s, at.Hx);
        Py = hn::NegMulAdd(alpha_y, at.s, at.Hy);
        Qxx = hn::NegMulAdd(alpha_x, hn::Add(at.Hx, Px), Qxx);
        Qyy = hn::NegMulAdd(alpha_y, hn::Add(at.Hy, Py), Qyy);
        Qxy = hn::NegMulAdd(alpha_x, at.Hy, hn::NegMulAdd(alpha_y, Px, Qxy));
        kx = hn::NegMulAdd(alpha_x, at.kq, kx);
        ky = hn::NegMulAdd(alpha_y, at.kq, ky);
      }
      xx[left] = hn::MulAdd(by_square, Qxx, xx[left]);
      yy[up] = hn::MulAdd(by_square, Qyy, yy[up]);
      const V xy = hn::Mul(by_square, Qxy);
      hn::StoreU(left == up ? xy : hn::Neg(xy), d, equations.xy[k] + i);
      const V x = hn::NegMulAdd(by_square, Px, hn::Mul(by_length, kx)),
              y = hn::NegMulAdd(by_square, Py, hn::Mul(by_length, ky));
      bx[left] = left == 0 ? hn::Add(bx[left], x) : hn::Sub(bx[left], x);
      by[up] = up == 0 ? hn::Add(by[up], y) : hn::Sub(by[up], y);
    }
    for (int side = 0; side < 2; ++side) {
      hn::StoreU(xx[side], d, equations.xx[side] + i);
      hn::StoreU(yy[side], d, equations.yy[side] + i);
      hn::StoreU(bx[side], d, equations.bx[side] + i);
      hn::StoreU(by[side], d, equations.by[side] + i);
    }
  }
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

float corner_equations(const CornerRun& run, const TensorRun& tensors, const float* weights, bool turning,
                       const EquationRow& equations) {
  return turning ? corner_equations_as<true>(run, tensors, weights, equations)
                 : corner_equations_as<false>(run, tensors, weights, equations);
}

void gather_equations(const EquationRow& above, const EquationRow& here, const EquationRow& below, int count,
                      const EntryRow& system, float* rhs) {
  constexpr int kRightDown = 0, kLeftDown = 1, kRightUp = 2, kLeftUp = 3;
  const D d;
  for (int i = 0; i < count; i += lanes()) {
    const auto at = [&](const float* row, int offset = 0) { return hn::LoadU(d, row + i + offset); };
    const auto add = [](V a, V b) { return hn::Add(a, b); };
    const auto sum4 = [&](V a, V b, V c, V e) { return add(add(a, b), add(c, e)); };
    const auto store = [&](V value, float* to) { store_interleaved<1>(&value, count - i, to + i); };
    const V rd = at(here.xy[kRightDown]), ld = at(here.xy[kLeftDown]), ru = at(here.xy[kRightUp]),
            lu = at(here.xy[kLeftUp]);
    const V xx0 = at(here.xx[0]), xx1 = at(here.xx[1]), yy0 = at(here.yy[0]), yy1 = at(here.yy[1]);
    const V right_xx1 = at(here.xx[1], 1), below_yy1 = at(below.yy[1]);
    const V own = add(sum4(xx0, xx1, yy0, yy1), hn::Mul(hn::Set(d, 2.0f), sum4(rd, ld, ru, lu)));
    store(add(own, sum4(at(here.xx[0], -1), right_xx1, at(above.yy[0]), below_yy1)), system.diagonal);
    const V right_ld = at(here.xy[kLeftDown], 1), right_lu = at(here.xy[kLeftUp], 1);
    store(hn::Neg(add(sum4(xx0, rd, ru, right_xx1), add(right_ld, right_lu))), system.right);
    const V below_ru = at(below.xy[kRightUp]), below_lu = at(below.xy[kLeftUp]);
    store(hn::Neg(add(sum4(yy0, rd, ld, below_yy1), add(below_ru, below_lu))), system.down);
    store(add(right_ld, below_ru), system.down_right);
    store(add(at(here.xy[kRightDown], -1), below_lu), system.down_left);
    const V in = sum4(at(here.bx[0], -1), at(here.bx[1], 1), at(above.by[0]), at(below.by[1]));
    store(hn::Sub(in, sum4(at(here.bx[0]), at(here.bx[1]), at(here.by[0]), at(here.by[1]))), rhs);
  }
}

void mean_normals(const CornerRun& run, float* normals) {
  const D d;
  const V one = hn::Set(d, 1.0f);
  for (int i = 0; i < run.count; i += lanes()) {
    const Gradients g(run, i);
    const auto bits = load_bits(run.present, i);
    V gx = hn::Zero(d), gy = gx, count = gx;
    for (int k = 0; k < 4; ++k) {
      const auto here = has_corner(bits, k);
      gx = hn::Add(gx, hn::IfThenElseZero(here, g.x[k & 1]));
      gy = hn::Add(gy, hn::IfThenElseZero(here, g.y[k >> 1]));
      count = hn::Add(count, hn::IfThenElseZero(here, one));
    }
    const V share = hn::Div(one, hn::Max(one, count));
    Vector3 n = Frame(run, i).raw(hn::Mul(gx, share), hn::Mul(gy, share));
    n = scaled(n, inverse_length(n));
    const V xyz[3] = {n.x, n.y, n.z};
    store_interleaved<3>(xyz, run.count - i, normals + 3 * i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(corner_energies);
HWY_EXPORT(corner_weights);
HWY_EXPORT(weighted_energy);
HWY_EXPORT(corner_equations);
HWY_EXPORT(gather_equations);
HWY_EXPORT(mean_normals);

void corner_energies(const CornerRun& run, const TensorRun& tensors, float* energies) {
  HWY_DYNAMIC_DISPATCH(corner_energies)(run, tensors, energies);
}

void corner_weights(const CornerRun& run, const TensorRun& tensors, const float* share, float half,
                    float* weights) {
  HWY_DYNAMIC_DISPATCH(corner_weights)(run, tensors, share, half, weights);
}

float weighted_energy(const CornerRun& run, const TensorRun& tensors, const float* weights) {
  return HWY_DYNAMIC_DISPATCH(weighted_energy)(run, tensors, weights);
}

float corner_equations(const CornerRun& run, const TensorRun& tensors, const float* weights, bool turning,
                       const EquationRow& equations) {
  return HWY_DYNAMIC_DISPATCH(corner_equations)(run, tensors, weights, turning, equations);
}

void gather_equations(const EquationRow& above, const EquationRow& here, const EquationRow& below, int count,
                      const EntryRow& system, float* rhs) {
  HWY_DYNAMIC_DISPATCH(gather_equations)(above, here, below, count, system, rhs);
}

void mean_normals(const CornerRun& run, float* normals) { HWY_DYNAMIC_DISPATCH(mean_normals)(run, normals); }

}  // namespace rakelight::kernels
#endif
