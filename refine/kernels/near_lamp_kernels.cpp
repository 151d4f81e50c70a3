// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/near_lamp_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/near_lamp_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// After foreach_target.h: once for each instruction set.
#include <hwy/contrib/math/math-inl.h>

#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

HWY_INLINE Vector3 load3(const float* const (&runs)[3], int k) {
  const D d;
  return {hn::LoadU(d, runs[0] + k), hn::LoadU(d, runs[1] + k), hn::LoadU(d, runs[2] + k)};
}

HWY_INLINE Vector3 difference(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

/// a x + b
HWY_INLINE Vector3 multiply_add(V a, const Vector3& x, const Vector3& b) {
  return {hn::MulAdd(a, x.x, b.x), hn::MulAdd(a, x.y, b.y), hn::MulAdd(a, x.z, b.z)};
}

/// v = u k with u = d - kappa offset and k = (d.u)^m |u|^-(3+m), at a vector of points.
struct NearVector {
  Vector3 offset, u;
  V u2, du;  ///< |u|^2 and d.u
  V k;       ///< 0 where the lamp does not reach for its lobe

  HWY_INLINE NearVector(const NearLight& light, const Vector3& point) {
    const D d;
    const Vector3 direction = set3(light.direction);
    offset = difference(point, set3(light.center));
    u = multiply_add(hn::Set(d, -light.inverse_distance), offset, direction);
    u2 = dot(u, u);
    du = dot(direction, u);
    if (light.lobe_exponent == 1.0f) {
      k = hn::Div(du, hn::Mul(u2, u2));
    } else {
      const V length = hn::Sqrt(u2);
      const V cosine = hn::Max(hn::Div(du, length), hn::Set(d, 1e-12f));
      const V lobe = hn::Exp(d, hn::Mul(hn::Set(d, light.lobe_exponent), hn::Log(d, cosine)));
      k = hn::Div(lobe, hn::Mul(u2, length));
    }
    k = hn::IfThenElseZero(hn::Gt(du, hn::Zero(d)), k);
  }
};

void near_incidence(const NearLight& light, const PointRuns& at, int count, float* value) {
  const D d;
  for (int i = 0; i < count; i += lanes()) {
    const NearVector v(light, load3(at.point, i));
    const V un = hn::Max(hn::Zero(d), dot(v.u, load3(at.normal, i)));
    hn::StoreU(hn::Mul(un, v.k), d, value + i);
  }
}

void near_derivatives(const NearLight& light, const PointRuns& at, const BroadRuns& broad, int count,
                      const NearDerivatives& out) {
  const D d;
  const Vector3 direction = set3(light.direction);
  const V m = hn::Set(d, light.lobe_exponent), m3 = hn::Set(d, light.lobe_exponent + 3),
          m2 = hn::Set(d, light.lobe_exponent - 2), kappa = hn::Set(d, light.inverse_distance);
  for (int i = 0; i < count; i += lanes()) {
    const Vector3 point = load3(at.point, i), n = load3(at.normal, i);
    const NearVector v(light, point);
    const V un = dot(v.u, n);
    const auto lit = hn::And(hn::Gt(un, hn::Zero(d)), hn::Gt(v.du, hn::Zero(d)));
    const V k = hn::IfThenElseZero(lit, v.k), value = hn::Mul(un, k);
    const V turn = hn::IfThenElseZero(lit, hn::Div(m, v.du));
    // Change of u and d gives d(v.n) = k (du.n) + (u.n) dk.
    const V along_d = hn::Mul(value, turn), along_u = hn::Mul(value, hn::Div(m3, v.u2));
    const Vector3 by_u = multiply_add(hn::Neg(along_u), v.u, multiply_add(along_d, direction, scaled(n, k)));
    const Vector3 by_d = multiply_add(along_d, v.u, by_u);
    hn::StoreU(value, d, out.value + i);
    hn::StoreU(dot(set3(light.tangent[0]), by_d), d, out.place[0] + i);
    hn::StoreU(dot(set3(light.tangent[1]), by_d), d, out.place[1] + i);
    hn::StoreU(hn::Neg(dot(v.offset, by_u)), d, out.place[2] + i);
    const V pull = hn::Mul(value, kappa);
    const Vector3 aim = multiply_add(hn::Neg(hn::Mul(pull, turn)), v.u, scaled(direction, hn::Mul(pull, m2)));
    hn::StoreU(aim.x, d, out.aim[0] + i);
    hn::StoreU(aim.y, d, out.aim[1] + i);
    hn::StoreU(aim.z, d, out.aim[2] + i);
    const V by_zeta = hn::Neg(hn::Mul(kappa, dot(by_u, point)));  // the point moves along its ray
    const Vector3 by_normal = scaled(v.u, k);
    for (int c = 0; c < kBroadChanges; ++c) {
      const Vector3 turned{hn::LoadU(d, broad.normal_by_c[0][c] + i),
                           hn::LoadU(d, broad.normal_by_c[1][c] + i),
                           hn::LoadU(d, broad.normal_by_c[2][c] + i)};
      hn::StoreU(hn::MulAdd(by_zeta, hn::LoadU(d, broad.B[c] + i), dot(by_normal, turned)), d,
                 out.shape[c] + i);
    }
  }
}

HWY_INLINE V fourth_power(V x) {
  const V square = hn::Mul(x, x);
  return hn::Mul(square, square);
}

void highlight_lobes(const NearLight& light, const PointRuns& at, int count,
                     float* (&lobes)[kHighlightLobes]) {
  const D d;
  const V one = hn::Set(d, 1.0f), tiny = hn::Set(d, 1e-20f);
  const auto inverse_length = [&](const Vector3& x) {
    return hn::Div(one, hn::Sqrt(hn::Max(tiny, dot(x, x))));
  };
  for (int i = 0; i < count; i += lanes()) {
    const Vector3 point = load3(at.point, i), n = load3(at.normal, i);
    const NearVector v(light, point);
    const V to_lamp = inverse_length(v.u);
    const Vector3 half =
        multiply_add(hn::Neg(inverse_length(point)), point, scaled(v.u, to_lamp));  // towards lamp and eye
    const V cosine = hn::Max(hn::Zero(d), hn::Mul(dot(n, half), inverse_length(half)));
    const V size = hn::IfThenElseZero(hn::Gt(dot(v.u, n), hn::Zero(d)), hn::Mul(v.k, hn::Sqrt(v.u2)));
    const V broad = fourth_power(fourth_power(cosine)), sharp = fourth_power(broad);
    hn::StoreU(hn::Mul(size, broad), d, lobes[0] + i);
    hn::StoreU(hn::Mul(size, sharp), d, lobes[1] + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(near_incidence);
HWY_EXPORT(near_derivatives);
HWY_EXPORT(highlight_lobes);

void near_incidence(const NearLight& light, const PointRuns& at, int count, float* value) {
  HWY_DYNAMIC_DISPATCH(near_incidence)(light, at, count, value);
}

void near_derivatives(const NearLight& light, const PointRuns& at, const BroadRuns& broad, int count,
                      const NearDerivatives& out) {
  HWY_DYNAMIC_DISPATCH(near_derivatives)(light, at, broad, count, out);
}

void highlight_lobes(const NearLight& light, const PointRuns& at, int count,
                     float* (&lobes)[kHighlightLobes]) {
  HWY_DYNAMIC_DISPATCH(highlight_lobes)(light, at, count, lobes);
}

}  // namespace rakelight::kernels
#endif
