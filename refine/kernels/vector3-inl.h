// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vectors of 3-vectors, and loads and stores that the kernels share. Included once for each instruction set.
#if defined(RAKELIGHT_VECTOR3_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RAKELIGHT_VECTOR3_INL_H
#undef RAKELIGHT_VECTOR3_INL_H
#else
#define RAKELIGHT_VECTOR3_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "refine/kernels/tile.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using Ints = hn::Rebind<std::int32_t, D>;
using Bytes = hn::Rebind<std::uint8_t, D>;

HWY_INLINE int lanes() { return static_cast<int>(hn::Lanes(D())); }

/// One number of x, y, z a pixel.
struct Vector3 {
  V x, y, z;
};

HWY_INLINE Vector3 set3(const float* v) {
  const D d;
  return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}

HWY_INLINE Vector3 load3(const TileRow (&rows)[3], int k) {
  const D d;
  return {hn::Load(d, rows[0].at + k), hn::Load(d, rows[1].at + k), hn::Load(d, rows[2].at + k)};
}

HWY_INLINE V dot(const Vector3& a, const Vector3& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE Vector3 scaled(const Vector3& a, V s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

template <int kParts>
HWY_INLINE void store_all_interleaved(const V* v, float* to) {
  const D d;
  if constexpr (kParts == 1) hn::StoreU(v[0], d, to);
  if constexpr (kParts == 3) hn::StoreInterleaved3(v[0], v[1], v[2], d, to);
  if constexpr (kParts == 4) hn::StoreInterleaved4(v[0], v[1], v[2], v[3], d, to);
}

/// Stores kParts numbers a pixel, interleaved, for the vector's first `count` pixels; nothing behind them is touched.
template <int kParts>
HWY_INLINE void store_interleaved(const V* v, int count, float* to) {
  if (count >= lanes()) return store_all_interleaved<kParts>(v, to);
  HWY_ALIGN float rest[kParts * HWY_MAX_BYTES / sizeof(float)];
  store_all_interleaved<kParts>(v, rest);
  std::copy_n(rest, kParts * count, to);
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#endif
