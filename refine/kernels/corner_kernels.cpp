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

/// Normal of Eq. (5) and what its derivatives are made of.
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

/// e(n) = n' G n - 2 h' n + e0 of a vector of pixels.
struct Tensor {
  V xx, xy, xz, yy, yz, zz, e0;
  Vector3 h;

  Tensor(const TensorRun& run, int i) {
    const D d;
    const auto at = [&](int part) { return hn::LoadU(d, run.part[part] + i); };
    xx = at(0), xy = at(1), xz = at(2), yy = at(3), yz = at(4), zz = at(5);
    h = {at(6), at(7), at(8)};
    e0 = at(9);
  }

  HWY_INLINE Vector3 times(const Vector3& v) const {
    return {dot({xx, xy, xz}, v), dot({xy, yy, yz}, v), dot({xz, yz, zz}, v)};
  }

  /// @param Gn G n
  HWY_INLINE V energy(const Vector3& n, const Vector3& Gn) const {
    const V twice = hn::Add(dot(h, n), dot(h, n));
    return hn::Add(hn::Sub(dot(n, Gn), twice), e0);
  }
};

/// Calls store(i, e): e the energies max(0, e) of the existing corners of the pixels i, i + 1, ..., 0 of the others.
template <class Store>
HWY_INLINE void for_corner_energies(const CornerRun& run, const TensorRun& tensors, const Store& store) {
  const D d;
  for (int i = 0; i < run.count; i += lanes()) {
    const Gradients g(run, i);
    const Frame frame(run, i);
    const Tensor tensor(tensors, i);
    const auto bits = load_bits(run.present, i);
    V e[4];
    for (int k = 0; k < 4; ++k) {
      Vector3 n = frame.raw(g.x[k & 1], g.y[k >> 1]);
      n = scaled(n, inverse_length(n));
      const V energy = hn::Max(hn::Zero(d), tensor.energy(n, tensor.times(n)));
      e[k] = hn::IfThenElseZero(has_corner(bits, k), energy);
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
    const Tensor tensor(tensors, i);
    V w[4];
    hn::LoadInterleaved4(d, weights + 4 * i, w[0], w[1], w[2], w[3]);
    V here = hn::Zero(d);
    for (int k = 0; k < 4; ++k) {
      Vector3 n = frame.raw(g.x[k & 1], g.y[k >> 1]);
      n = scaled(n, inverse_length(n));
      here = hn::MulAdd(w[k], tensor.energy(n, tensor.times(n)), here);
    }
    sum = hn::Add(sum, hn::IfThenElseZero(hn::FirstN(d, static_cast<size_t>(run.count - i)), here));
  }
  return hn::GetLane(hn::SumOfLanes(d, sum));
}

/// d n / d(zeta_x) or d(zeta_y): J = d raw, projected on the tangent plane when the length turns along, over the length.
template <bool kTurning>
HWY_INLINE Vector3 normal_slope(const Vector3& J, const Vector3& n, V inverse_d) {
  if constexpr (!kTurning) return scaled(J, inverse_d);
  const V along = dot(J, n);
  return scaled(
      {hn::NegMulAdd(along, n.x, J.x), hn::NegMulAdd(along, n.y, J.y), hn::NegMulAdd(along, n.z, J.z)},
      inverse_d);
}

template <bool kTurning>
HWY_INLINE float corner_equations_as(const CornerRun& run, const TensorRun& tensors, const float* weights,
                                     const EquationRow& equations) {
  const D d;
  const V none = hn::Zero(d);
  V sum = none;
  for (int i = 0; i < run.count; i += lanes()) {
    const Gradients g(run, i);
    const Frame frame(run, i);
    const Tensor tensor(tensors, i);
    const Vector3 Jx{frame.fx, none, hn::Neg(frame.x)}, Jy{none, frame.fy, hn::Neg(frame.y)};
    const auto inside = hn::FirstN(d, static_cast<size_t>(run.count - i));
    V w[4];
    hn::LoadInterleaved4(d, weights + 4 * i, w[0], w[1], w[2], w[3]);
    V xx[2] = {none, none}, yy[2] = {none, none}, bx[2] = {none, none}, by[2] = {none, none};
    for (int k = 0; k < 4; ++k) {
      const int left = k & 1, up = k >> 1;
      const V weight = hn::IfThenElseZero(inside, w[k]);
      Vector3 n = frame.raw(g.x[left], g.y[up]);
      const V inverse_d = inverse_length(n);
      n = scaled(n, inverse_d);
      const Vector3 Gn = tensor.times(n);
      sum = hn::MulAdd(weight, tensor.energy(n, Gn), sum);
      const Vector3 nx = normal_slope<kTurning>(Jx, n, inverse_d),
                    ny = normal_slope<kTurning>(Jy, n, inverse_d);
      const Vector3 miss{hn::Sub(tensor.h.x, Gn.x), hn::Sub(tensor.h.y, Gn.y), hn::Sub(tensor.h.z, Gn.z)};
      const Vector3 Gnx = tensor.times(nx);
      xx[left] = hn::MulAdd(weight, dot(nx, Gnx), xx[left]);
      yy[up] = hn::MulAdd(weight, dot(ny, tensor.times(ny)), yy[up]);
      const V xy = hn::Mul(weight, dot(ny, Gnx));
      hn::StoreU(left == up ? xy : hn::Neg(xy), d, equations.xy[k] + i);
      const V x = hn::Mul(weight, dot(nx, miss)), y = hn::Mul(weight, dot(ny, miss));
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
                      const SystemRun& system) {
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
    store(hn::Sub(in, sum4(at(here.bx[0]), at(here.bx[1]), at(here.by[0]), at(here.by[1]))), system.rhs);
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
                      const SystemRun& system) {
  HWY_DYNAMIC_DISPATCH(gather_equations)(above, here, below, count, system);
}

void mean_normals(const CornerRun& run, float* normals) { HWY_DYNAMIC_DISPATCH(mean_normals)(run, normals); }

}  // namespace rakelight::kernels
#endif
