// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/image_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/light_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// Of one channel; pixels with l.n <= least have no say in l.
void light_sums_of_channel(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, int c,
                           Stretch stretch, float (&A)[10], float (&b)[4]) {
  const D d;
  const Vector3 l = set3(lamp.l[c]);
  const V least = hn::Set(d, lamp.least);
  V a[10], r[4];
  for (V& each : a) each = hn::Zero(d);
  for (V& each : r) each = hn::Zero(d);
  for (int k = stretch.begin; k < stretch.end; k += lanes()) {
    Vector3 n = load3(surface.normal, k);
    const Samples samples(image, c, k);
    const V trust = hn::IfThenElseZero(samples.usable, load_weights(image, k));
    const V rho = hn::Load(d, surface.albedo[c].at + k);
    const V wr = hn::Mul(trust, rho), wrr = hn::Mul(wr, rho);
    const auto lit = hn::Gt(dot(l, n), least);
    n = {hn::IfThenElseZero(lit, n.x), hn::IfThenElseZero(lit, n.y), hn::IfThenElseZero(lit, n.z)};
    const Vector3 wn = scaled(n, wrr);
    a[0] = hn::MulAdd(wn.x, n.x, a[0]);
    a[1] = hn::MulAdd(wn.x, n.y, a[1]);
    a[2] = hn::MulAdd(wn.x, n.z, a[2]);
    a[3] = hn::Add(wn.x, a[3]);
    a[4] = hn::MulAdd(wn.y, n.y, a[4]);
    a[5] = hn::MulAdd(wn.y, n.z, a[5]);
    a[6] = hn::Add(wn.y, a[6]);
    a[7] = hn::MulAdd(wn.z, n.z, a[7]);
    a[8] = hn::Add(wn.z, a[8]);
    a[9] = hn::Add(wrr, a[9]);
    const V I = hn::Mul(wr, samples.radiance);
    r[0] = hn::MulAdd(I, n.x, r[0]);
    r[1] = hn::MulAdd(I, n.y, r[1]);
    r[2] = hn::MulAdd(I, n.z, r[2]);
    r[3] = hn::Add(I, r[3]);
  }
  for (int j = 0; j < 10; ++j) A[j] = hn::GetLane(hn::SumOfLanes(d, a[j]));
  for (int j = 0; j < 4; ++j) b[j] = hn::GetLane(hn::SumOfLanes(d, r[j]));
}

void light_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, Stretch stretch,
                LightSums& sums) {
  for (int c = 0; c < 3; ++c) light_sums_of_channel(surface, lamp, image, c, stretch, sums.A[c], sums.b[c]);
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(light_sums);

void light_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, Stretch stretch,
                LightSums& sums) {
  HWY_DYNAMIC_DISPATCH(light_sums)(surface, lamp, image, stretch, sums);
}

}  // namespace rakelight::kernels
#endif
