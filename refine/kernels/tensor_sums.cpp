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
};

HWY_INLINE Sums load_sums(const TileTensors& tile, int k) {
  const D d;
  const auto at = [&](const TileRow& row) { return hn::Load(d, row.at + k); };
  return {at(tile.xx), at(tile.xy), at(tile.xz), at(tile.yy), at(tile.yz),
          at(tile.zz), at(tile.hx), at(tile.hy), at(tile.hz), at(tile.e0)};
}

HWY_INLINE void store_sums(const Sums& sums, TileTensors& tile, int k) {
  const D d;
  const auto store = [&](V value, TileRow& row) { hn::Store(value, d, row.at + k); };
  store(sums.xx, tile.xx);
  store(sums.xy, tile.xy);
  store(sums.xz, tile.xz);
  store(sums.yy, tile.yy);
  store(sums.yz, tile.yz);
  store(sums.zz, tile.zz);
  store(sums.hx, tile.hx);
  store(sums.hy, tile.hy);
  store(sums.hz, tile.hz);
  store(sums.e0, tile.e0);
}

/// A sample's channels: rho and I - rho phi, 0 where the channel cannot be used.
struct Rests {
  V rho[3], rest[3], used[3];

  template <LightKind kKind>
  HWY_INLINE Rests(const Light<kKind>& light, const V (&albedo)[3], const TileImage& image, int k) {
    const D d;
    for (int c = 0; c < 3; ++c) {
      const Samples samples(image, c, k);
      rho[c] = hn::IfThenElseZero(samples.usable, albedo[c]);
      rest[c] = hn::NegMulAdd(rho[c], light.phi(c), hn::IfThenElseZero(samples.usable, samples.radiance));
      used[c] = hn::IfThenElseZero(samples.usable, hn::Set(d, 1.0f));
    }
  }
};

/// A near lamp's channels share one vector v: G += w sum (rho e)^2 v v'.
HWY_INLINE void add_channels(const Light<LightKind::near>& light, const Rests& of, V weight, Sums& sums) {
  const D d;
  V strength2 = hn::Zero(d), strength_rest = strength2;
  for (int c = 0; c < 3; ++c) {
    sums.e0 = hn::MulAdd(hn::Mul(weight, of.rest[c]), of.rest[c], sums.e0);
    const V strength = hn::Mul(of.rho[c], light.strength(c));
    strength2 = hn::MulAdd(strength, strength, strength2);
    strength_rest = hn::MulAdd(strength, of.rest[c], strength_rest);
  }
  weight = hn::IfThenElseZero(hn::Gt(light.incidence(), light.least()), weight);
  sums.add(light.v(), hn::Mul(weight, strength2), hn::Mul(weight, strength_rest));
}

template <LightKind kKind>
HWY_INLINE void add_channels(const Light<kKind>& light, const Rests& of, V weight, Sums& sums) {
  for (int c = 0; c < 3; ++c) {
    sums.e0 = hn::MulAdd(hn::Mul(weight, of.rest[c]), of.rest[c], sums.e0);
    const V lit = hn::IfThenElseZero(hn::Gt(light.incidence(c), light.least()), hn::Mul(weight, of.rho[c]));
    sums.add(light.l(c), hn::Mul(lit, of.rho[c]), hn::Mul(lit, of.rest[c]));
  }
}

/// The sums that tie albedo to normal at one vector of pixels.
struct Coupling {
  V SS[3];
  Vector3 Sl[3];

  HWY_INLINE Coupling(const AlbedoCoupling& tile, int k) {
    for (int c = 0; c < 3; ++c) {
      SS[c] = hn::Load(D(), tile.SS[c].at + k);
      Sl[c] = load3(tile.Sl[c], k);
    }
  }

  HWY_INLINE void store(AlbedoCoupling& tile, int k) const {
    const D d;
    for (int c = 0; c < 3; ++c) {
      hn::Store(SS[c], d, tile.SS[c].at + k);
      hn::Store(Sl[c].x, d, tile.Sl[c][0].at + k);
      hn::Store(Sl[c].y, d, tile.Sl[c][1].at + k);
      hn::Store(Sl[c].z, d, tile.Sl[c][2].at + k);
    }
  }

  /// @param l of the channel; for near lamps v, which the strength is a factor of
  HWY_INLINE void add(int c, V weight, V incidence, V least, V phi, const Vector3& l, V strength) {
    const V S = hn::Add(hn::Max(least, incidence), phi), wS = hn::Mul(weight, S);
    SS[c] = hn::MulAdd(wS, S, SS[c]);
    const V lit = hn::IfThenElseZero(hn::Gt(incidence, least), hn::Mul(wS, strength));
    Sl[c] = {hn::MulAdd(lit, l.x, Sl[c].x), hn::MulAdd(lit, l.y, Sl[c].y), hn::MulAdd(lit, l.z, Sl[c].z)};
  }
};

HWY_INLINE void add_coupling(const Light<LightKind::near>& light, const Rests& of, V weight, Coupling& sums) {
  for (int c = 0; c < 3; ++c)
    sums.add(c, hn::Mul(weight, of.used[c]), light.incidence(c), light.least(), light.phi(c), light.v(),
             light.strength(c));
}

template <LightKind kKind>
HWY_INLINE void add_coupling(const Light<kKind>& light, const Rests& of, V weight, Coupling& sums) {
  for (int c = 0; c < 3; ++c)
    sums.add(c, hn::Mul(weight, of.used[c]), light.incidence(c), light.least(), light.phi(c), light.l(c),
             hn::Set(D(), 1.0f));
}

template <LightKind kKind>
HWY_INLINE V cauchy_weight(const Light<kKind>& light, const Rests& of, V inverse_square) {
  const D d;
  V squares = hn::Zero(d), channels = squares;
  for (int c = 0; c < 3; ++c) {
    const V r = hn::MulSub(of.rho[c], hn::Max(light.least(), light.incidence(c)), of.rest[c]);
    squares = hn::MulAdd(r, r, squares);
    channels = hn::Add(channels, of.used[c]);
  }
  return hn::Div(channels, hn::MulAdd(squares, inverse_square, hn::Max(channels, hn::Set(d, 1.0f))));
}

/// @param weight weight(light, rests, image, which, k)
template <bool kCoupled, class Weight>
HWY_INLINE void add_images(const TileSurface& surface, const ImageChoice& choice, Stretch stretch,
                           const Weight& weight, TileTensors& tile, AlbedoCoupling& coupling) {
  const D d;
  for (int k = stretch.begin; k < stretch.end; k += lanes()) {
    const Vector3 n = load3(surface.normal, k);
    const V albedo[3] = {hn::Load(d, surface.albedo[0].at + k), hn::Load(d, surface.albedo[1].at + k),
                         hn::Load(d, surface.albedo[2].at + k)};
    Sums sums = load_sums(tile, k);
    [[maybe_unused]] Coupling couplings(coupling, k);
    for_each_image(choice, [&](auto light, const TileImage& image, int which) {
      light.move_to(surface, k, n);
      const Rests rests(light, albedo, image, k);
      const V w = weight(light, rests, image, which, k);
      add_channels(light, rests, w, sums);
      if constexpr (kCoupled) add_coupling(light, rests, w, couplings);
    });
    store_sums(sums, tile, k);
    if constexpr (kCoupled) couplings.store(coupling, k);
  }
}

template <class Weight>
HWY_INLINE void add_images(const TileSurface& surface, const ImageChoice& choice, Stretch stretch,
                           const Weight& weight, TileTensors& tile, AlbedoCoupling* coupling) {
  AlbedoCoupling unused;
  if (coupling == nullptr)
    add_images<false>(surface, choice, stretch, weight, tile, unused);
  else
    add_images<true>(surface, choice, stretch, weight, tile, *coupling);
}

void add_tensors(const TileSurface& surface, const ImageChoice& choice, Stretch stretch, TileTensors& sums,
                 AlbedoCoupling* coupling) {
  const auto given = [](const auto&, const Rests&, const TileImage& image, int, int k) {
    return load_weights(image, k);
  };
  add_images(surface, choice, stretch, given, sums, coupling);
}

void reweigh_and_add_tensors(const TileSurface& surface, const ImageChoice& choice, float scale,
                             Stretch stretch, float* const* weights, TileTensors& sums,
                             AlbedoCoupling* coupling) {
  const V inverse_square = hn::Set(D(), 1.0f / (scale * scale));
  const auto made = [&](const auto& light, const Rests& rests, const TileImage&, int which, int k) {
    const V weight = cauchy_weight(light, rests, inverse_square);
    hn::StoreU(weight, D(), weights[which] + k);
    return weight;
  };
  add_images(surface, choice, stretch, made, sums, coupling);
}

void eliminate_albedo(const TileSurface& surface, const AlbedoCoupling& coupling, TileTensors& tensors) {
  const D d;
  for (int k = 0; k < kTilePixels; k += lanes()) {
    const Vector3 n = load3(surface.normal, k);
    const Coupling at(coupling, k);
    Sums sums = load_sums(tensors, k);
    for (int c = 0; c < 3; ++c) {
      const V rho = hn::Load(d, surface.albedo[c].at + k);
      const V share = hn::Div(rho, hn::Sqrt(hn::Max(at.SS[c], hn::Set(d, 1e-12f))));
      const Vector3 K = scaled(at.Sl[c], share);  // its root
      const V along = dot(K, n);
      sums.add(K, hn::Set(d, -1.0f), hn::Neg(along));
      sums.e0 = hn::NegMulAdd(along, along, sums.e0);
    }
    store_sums(sums, tensors, k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(add_tensors);

void add_tensors(const TileSurface& surface, const ImageChoice& choice, Stretch stretch, TileTensors& sums,
                 AlbedoCoupling* coupling) {
  HWY_DYNAMIC_DISPATCH(add_tensors)(surface, choice, stretch, sums, coupling);
}

HWY_EXPORT(reweigh_and_add_tensors);

void reweigh_and_add_tensors(const TileSurface& surface, const ImageChoice& choice, float scale,
                             Stretch stretch, float* const* weights, TileTensors& sums,
                             AlbedoCoupling* coupling) {
  HWY_DYNAMIC_DISPATCH(reweigh_and_add_tensors)(surface, choice, scale, stretch, weights, sums, coupling);
}

HWY_EXPORT(eliminate_albedo);

void eliminate_albedo(const TileSurface& surface, const AlbedoCoupling& coupling, TileTensors& tensors) {
  HWY_DYNAMIC_DISPATCH(eliminate_albedo)(surface, coupling, tensors);
}

}  // namespace rakelight::kernels
#endif
