// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/residual_sums.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/residual_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// row += a * b at pixels k, k + 1, ...
HWY_INLINE void add_product(V a, V b, TileRow& row, int k) {
  const D d;
  hn::Store(hn::MulAdd(a, b, hn::Load(d, row.at + k)), d, row.at + k);
}

HWY_INLINE Vector3 light_vector(const Light<LightKind::near>& light, int c) {
  return scaled(light.v(), light.strength(c));
}

template <LightKind kKind>
HWY_INLINE Vector3 light_vector(const Light<kKind>& light, int c) {
  return light.l(c);
}

HWY_INLINE void add_product(V a, const Vector3& v, TileRow (&rows)[3], int k) {
  add_product(a, v.x, rows[0], k);
  add_product(a, v.y, rows[1], k);
  add_product(a, v.z, rows[2], k);
}

void add_residual_draws(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                        const float (&factor)[kDraws], TileDraws& sums) {
  with_light(lamp, [&](auto light) {
    const D d;
    const V zero = hn::Zero(d), least = hn::Set(d, lamp.least);
    for (int k = 0; k < kTilePixels; k += lanes()) {
      light.move_to(surface, k, load3(surface.normal, k));
      const V weight = hn::LoadU(d, image.weight + k);
      Vector3 pull{zero, zero, zero};  // sum over channels of w rho l r
      V wSr[3];
      for (int c = 0; c < 3; ++c) {
        const Samples samples(image, c, k);
        const V rho = hn::Load(d, surface.albedo[c].at + k),
                S = hn::IfThenElseZero(samples.usable, shading(light, c)),
                I = hn::IfThenElseZero(samples.usable, samples.radiance), rho_S = hn::Mul(rho, S),
                r = hn::Sub(I, rho_S), wS = hn::Mul(weight, S);
        const V lit = hn::IfThenElseZero(hn::And(samples.usable, hn::Gt(light.incidence(c), least)), weight);
        const Vector3 l = light_vector(light, c);
        add_product(hn::Mul(lit, hn::Sub(r, rho_S)), l, sums.by_rho[c], k);
        const V share = hn::Mul(hn::Mul(lit, rho), r);
        pull = {hn::MulAdd(share, l.x, pull.x), hn::MulAdd(share, l.y, pull.y),
                hn::MulAdd(share, l.z, pull.z)};
        add_product(wS, S, sums.SS[c], k);
        wSr[c] = hn::Mul(wS, r);
      }
      for (int draw = 0; draw < kDraws; ++draw) {
        const V times = hn::Set(d, factor[draw]);
        add_product(times, pull.x, sums.q[0][draw], k);
        add_product(times, pull.y, sums.q[1][draw], k);
        add_product(times, pull.z, sums.q[2][draw], k);
        for (int c = 0; c < 3; ++c) add_product(times, wSr[c], sums.Sr[c][draw], k);
      }
    }
  });
}

void add_lit_weights(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, TileRow& lit) {
  with_light(lamp, [&](auto light) {
    const D d;
    for (int k = 0; k < kTilePixels; k += lanes()) {
      light.move_to(surface, k, load3(surface.normal, k));
      const V most = hn::Max(light.incidence(0), hn::Max(light.incidence(1), light.incidence(2)));
      // Second-order light has no shadow's edge: it comes from everywhere.
      const V least = hn::Set(d, lamp.kind == LightKind::second_order ? -1e30f : 0.0f);
      const auto seen = hn::Or(Samples(image, 0, k).usable,
                               hn::Or(Samples(image, 1, k).usable, Samples(image, 2, k).usable));
      const V weight = hn::IfThenElseZero(hn::And(seen, hn::Gt(most, least)), hn::LoadU(d, image.weight + k));
      hn::Store(hn::Add(weight, hn::Load(d, lit.at + k)), d, lit.at + k);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(add_residual_draws);
HWY_EXPORT(add_lit_weights);

void add_residual_draws(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                        const float (&factor)[kDraws], TileDraws& sums) {
  HWY_DYNAMIC_DISPATCH(add_residual_draws)(surface, lamp, image, factor, sums);
}

void add_lit_weights(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, TileRow& lit) {
  HWY_DYNAMIC_DISPATCH(add_lit_weights)(surface, lamp, image, lit);
}

}  // namespace rakelight::kernels
#endif
