// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/image_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/interleave.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

void deinterleave3(const float* triples, int count, TileRow (&rows)[3]) {
  constexpr int kLine = 64 / sizeof(float);
  const D d;
  int k = 0;
  for (; k + lanes() <= count; k += lanes()) {
    Vector3 v;
    for (int j = 0; j < 3 * lanes(); j += kLine)
      __builtin_prefetch(triples + 3 * (k + kTilePixels) + j, 0, 2);
    hn::LoadInterleaved3(d, triples + 3 * k, v.x, v.y, v.z);
    hn::Store(v.x, d, rows[0].at + k);
    hn::Store(v.y, d, rows[1].at + k);
    hn::Store(v.z, d, rows[2].at + k);
  }
  for (; k < count; ++k)
    for (int c = 0; c < 3; ++c) rows[c].at[k] = triples[3 * k + c];
}

void interleave3(const TileRow (&rows)[3], int count, float* triples) {
  for (int k = 0; k < count; k += lanes()) {
    const Vector3 v = load3(rows, k);
    const V parts[] = {v.x, v.y, v.z};
    store_interleaved<3>(parts, count - k, triples + 3 * k);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(deinterleave3);
HWY_EXPORT(interleave3);

void deinterleave3(const float* triples, int count, TileRow (&rows)[3]) {
  HWY_DYNAMIC_DISPATCH(deinterleave3)(triples, count, rows);
}

void interleave3(const TileRow (&rows)[3], int count, float* triples) {
  HWY_DYNAMIC_DISPATCH(interleave3)(rows, count, triples);
}

}  // namespace rakelight::kernels
#endif
