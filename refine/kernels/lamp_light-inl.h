// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The light of one lamp at a vector of pixels: refine/lamp.h in vector form. Included once for each instruction set.
#if defined(RAKELIGHT_LAMP_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAKELIGHT_LAMP_LIGHT_INL_H
#undef RAKELIGHT_LAMP_LIGHT_INL_H
#else
#define RAKELIGHT_LAMP_LIGHT_INL_H
#endif

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "refine/kernels/tile.h"
#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// Starts to fetch the next samples of kVectors vectors from codes on. A tile is read in many short runs: too short for the processor to
/// see where they go on.
template <int kVectors>
HWY_INLINE void fetch_next(const TileImage& image, const std::uint16_t* codes) {
  constexpr int kLine = 64 / sizeof(std::uint16_t), kSecondLevel = 2;  // the first has no room for two tiles
  for (int k = 0; k < kVectors * lanes(); k += kLine)
    __builtin_prefetch(codes + image.next + k, 0, kSecondLevel);
}

HWY_INLINE V load_weights(const TileImage& image, int k) {
  __builtin_prefetch(image.weight + image.next + k, 0, 2);
  return hn::LoadU(D(), image.weight + k);
}

/// Radiance of one channel at a vector of pixels, and which of them can be used.
struct Samples {
  V radiance;
  hn::Mask<D> usable;

  HWY_INLINE Samples(const TileImage& image, int c, int k) {
    const D d;
    const hn::Rebind<std::uint16_t, D> shorts;
    const auto codes = hn::PromoteTo(Ints(), hn::LoadU(shorts, image.codes[c] + k));
    fetch_next<1>(image, image.codes[c] + k);
    usable = hn::RebindMask(d, hn::Ne(codes, hn::Set(Ints(), TileImage::kUnusable)));
    radiance = hn::MulAdd(hn::ConvertTo(d, codes), hn::Set(d, image.step[c]), hn::Set(d, image.least[c]));
  }
};

/// Light at the pixels k, k + 1, ... of a tile: S_c = max(least, l_c . n) + phi_c.
template <LightKind kKind>
class Light;

template <>
class Light<LightKind::far> {
 public:
  explicit Light(const TileLamp& lamp) : lamp_(lamp) {}
  void move_to(const TileSurface&, int, const Vector3& n) { n_ = n; }
  Vector3 l(int c) const { return set3(lamp_.l[c]); }
  V phi(int c) const { return hn::Set(D(), lamp_.phi[c]); }
  V incidence(int c) const { return dot(l(c), n_); }
  V least() const { return hn::Set(D(), lamp_.least); }

 private:
  const TileLamp& lamp_;
  Vector3 n_;
};

template <>
class Light<LightKind::near> {
 public:
  explicit Light(const TileLamp& lamp) : lamp_(lamp) {}

  void move_to(const TileSurface& surface, int k, const Vector3& n) {
    const D d;
    const Vector3 offset = load3(surface.offset, k), direction = set3(lamp_.direction);
    const V kappa = hn::Set(d, lamp_.inverse_distance);
    const Vector3 u{hn::NegMulAdd(kappa, offset.x, direction.x), hn::NegMulAdd(kappa, offset.y, direction.y),
                    hn::NegMulAdd(kappa, offset.z, direction.z)};
    const V u2 = dot(u, u);
    const V along = hn::Max(hn::Zero(d), dot(direction, u));
    if (lamp_.lobe_exponent == 1.0f) {
      v_ = scaled(u, hn::Div(along, hn::Mul(u2, u2)));
    } else {
      const V length = hn::Sqrt(u2);
      const V cosine = hn::Max(hn::Div(along, length), hn::Set(d, 1e-12f));
      const V lobe = hn::Exp(d, hn::Mul(hn::Set(d, lamp_.lobe_exponent), hn::Log(d, cosine)));
      v_ = scaled(u, hn::Div(lobe, hn::Mul(u2, length)));
    }
    incidence_ = dot(v_, n);
  }

  const Vector3& v() const { return v_; }
  V strength(int c) const { return hn::Set(D(), lamp_.strength[c]); }
  V phi(int c) const { return hn::Set(D(), lamp_.phi[c]); }
  V incidence() const { return incidence_; }
  V incidence(int c) const { return hn::Mul(strength(c), incidence_); }
  V least() const { return hn::Set(D(), lamp_.least); }

 private:
  const TileLamp& lamp_;
  Vector3 v_;
  V incidence_;
};

/// Linear in the normal and exact at n: l + 2 Q n, phi - n' Q n.
template <>
class Light<LightKind::second_order> {
 public:
  explicit Light(const TileLamp& lamp) : lamp_(lamp) {}

  void move_to(const TileSurface&, int, const Vector3& n) {
    const D d;
    const V two = hn::Set(d, 2.0f);
    n_ = n;
    for (int c = 0; c < 3; ++c) {
      const float(&q)[6] = lamp_.Q[c];
      const Vector3 Qn{dot({hn::Set(d, q[0]), hn::Set(d, q[3]), hn::Set(d, q[4])}, n),
                       dot({hn::Set(d, q[3]), hn::Set(d, q[1]), hn::Set(d, q[5])}, n),
                       dot({hn::Set(d, q[4]), hn::Set(d, q[5]), hn::Set(d, q[2])}, n)};
      const Vector3 l = set3(lamp_.l[c]);
      l_[c] = {hn::MulAdd(two, Qn.x, l.x), hn::MulAdd(two, Qn.y, l.y), hn::MulAdd(two, Qn.z, l.z)};
      phi_[c] = hn::Sub(hn::Set(d, lamp_.phi[c]), dot(n, Qn));
    }
  }

  Vector3 l(int c) const { return l_[c]; }
  V phi(int c) const { return phi_[c]; }
  V incidence(int c) const { return dot(l_[c], n_); }
  V least() const { return hn::Set(D(), lamp_.least); }

 private:
  const TileLamp& lamp_;
  Vector3 n_;
  Vector3 l_[3];
  V phi_[3];
};

/// Shading of channel c.
template <LightKind kKind>
HWY_INLINE V shading(const Light<kKind>& light, int c) {
  return hn::Add(hn::Max(light.least(), light.incidence(c)), light.phi(c));
}

/// Calls body(Light<kind>) for the lamp's kind.
template <class Body>
HWY_INLINE void with_light(const TileLamp& lamp, const Body& body) {
  switch (lamp.kind) {
    case LightKind::far:
      return body(Light<LightKind::far>(lamp));
    case LightKind::near:
      return body(Light<LightKind::near>(lamp));
    case LightKind::second_order:
      return body(Light<LightKind::second_order>(lamp));
  }
}

/// Calls body(Light<kind>, image, which) for the images chosen.
template <class Body>
HWY_INLINE void for_each_image(const ImageChoice& choice, const Body& body) {
  for (int j = 0; j < choice.count; ++j) {
    const int i = choice.which[j];
    with_light(choice.lamps[i], [&](auto light) { body(light, choice.images[i], i); });
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#endif
