// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/image_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/tensor_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// The ten sums at one vector of pixels.
struct Sums {
  V xx, xy, xz, yy, yz, zz, hx, hy, hz, e0;

  explicit Sums(D d)
      : xx(hn::Zero(d)), xy(xx), xz(xx), yy(xx), yz(xx), zz(xx), hx(xx), hy(xx), hz(xx), e0(xx) {}

  /// w (l . n - rest)^2 without the square of rest: G += w l l', h += wrest l.
  HWY_INLINE void add(const Vector3& l, V w, V wrest) {
    const Vector3 wl = scaled(l, w);
    xx = hn::MulAdd(wl.x, l.x, xx);
    xy = hn::MulAdd(wl.x, l.y, xy);
    xz = hn::MulAdd(wl.x, l.z, xz);
    yy = hn::MulAdd(wl.y, l.y, yy);
    yz = hn::MulAdd(wl.y, l.z, yz);
    zz = hn::MulAdd(wl.z, l.z, zz);
    hx = hn::MulAdd(wrest, l.x, hx);
    hy = hn::MulAdd(wrest, l.y, hy);
    hz = hn::MulAdd(wrest, l.z, hz);
  }

  HWY_INLINE void add_to(TileTensors& tile, int k) const {
    const D d;
    const auto add_row = [&](V value, TileRow& row) {
      hn::Store(hn::Add(value, hn::Load(d, row.at + k)), d, row.at + k);
    };
    add_row(xx, tile.xx);
    add_row(xy, tile.xy);
    add_row(xz, tile.xz);
    add_row(yy, tile.yy);
    add_row(yz, tile.yz);
    add_row(zz, tile.zz);
    add_row(hx, tile.hx);
    add_row(hy, tile.hy);
    add_row(hz, tile.hz);
    add_row(e0, tile.e0);
  }
};

/// A near lamp's channels share one vector v: G += w sum (rho e)^2 v v'.
HWY_INLINE void add_channels(const Light<LightKind::near>& light, const V (&rho)[3], const V (&rest)[3],
                             V weight, V least, Sums& sums) {
  const D d;
  V strength2 = hn::Zero(d), strength_rest = strength2;
  for (int c = 0; c < 3; ++c) {
    const V strength = hn::Mul(rho[c], light.strength(c));
    strength2 = hn::MulAdd(strength, strength, strength2);
    strength_rest = hn::MulAdd(strength, rest[c], strength_rest);
  }
  weight = hn::IfThenElseZero(hn::Gt(light.incidence(), least), weight);
  sums.add(light.v(), hn::Mul(weight, strength2), hn::Mul(weight, strength_rest));
}

template <LightKind kKind>
HWY_INLINE void add_channels(const Light<kKind>& light, const V (&rho)[3], const V (&rest)[3], V weight,
                             V least, Sums& sums) {
  for (int c = 0; c < 3; ++c) {
    const V lit = hn::IfThenElseZero(hn::Gt(light.incidence(c), least), hn::Mul(weight, rho[c]));
    sums.add(light.l(c), hn::Mul(lit, rho[c]), hn::Mul(lit, rest[c]));
  }
}

void add_tensors(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                 TileTensors& tile) {
  with_light(lamp, [&](auto light) {
    const D d;
    const V least = hn::Set(d, lamp.least);
    for (int k = 0; k < kTilePixels; k += lanes()) {
      light.move_to(surface, k, load3(surface.normal, k));
      const V weight = hn::LoadU(d, image.weight + k);
      Sums sums(d);
      V rho[3], rest[3];
      for (int c = 0; c < 3; ++c) {
        const Samples samples(image, c, k);
        rho[c] = hn::IfThenElseZero(samples.usable, hn::Load(d, surface.albedo[c].at + k));
        rest[c] = hn::NegMulAdd(rho[c], light.phi(c), hn::IfThenElseZero(samples.usable, samples.radiance));
        sums.e0 = hn::MulAdd(hn::Mul(weight, rest[c]), rest[c], sums.e0);
      }
      add_channels(light, rho, rest, weight, least, sums);
      sums.add_to(tile, k);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(add_tensors);

void add_tensors(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                 TileTensors& tile) {
  HWY_DYNAMIC_DISPATCH(add_tensors)(surface, lamp, image, tile);
}

}  // namespace rakelight::kernels
#endif
