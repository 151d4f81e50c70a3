// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/plain_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/plain_lights.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

void plain_lights(const TileSurface& surface, Stretch stretch, PlainLights& lights) {
  const D d;
  for (int c = 0; c < 3; ++c) {
    V a[10], r[4];
    for (V& each : a) each = hn::Zero(d);
    for (V& each : r) each = hn::Zero(d);
    for (int k = stretch.begin; k < stretch.end; k += lanes()) {
      const V rho = hn::Load(d, surface.albedo[c].at + k);
      const Vector3 n = scaled(load3(surface.normal, k), rho);
      hn::Store(n.x, d, lights.rho_n[c][0].at + k);
      hn::Store(n.y, d, lights.rho_n[c][1].at + k);
      hn::Store(n.z, d, lights.rho_n[c][2].at + k);
      const V h[] = {n.x, n.y, n.z, rho};
      int at = 0;
      for (int row = 0; row < 4; ++row) {
        r[row] = hn::Add(r[row], h[row]);
        for (int column = row; column < 4; ++column, ++at) a[at] = hn::MulAdd(h[row], h[column], a[at]);
      }
    }
    for (int j = 0; j < 10; ++j) lights.A[c][j] = hn::GetLane(hn::SumOfLanes(d, a[j]));
    for (int j = 0; j < 4; ++j) lights.rho_h[c][j] = hn::GetLane(hn::SumOfLanes(d, r[j]));
  }
}

/// b of kImages images in one channel: each load of rho h serves all of them.
template <size_t kImages>
HWY_INLINE void plain_rhs_of_channel(const TileSurface& surface, const PlainLights& lights,
                                     const TileImage* const (&images)[2], int c, Stretch stretch,
                                     float (*const (&b)[2])[4]) {
  const D d;
  const hn::Rebind<std::uint16_t, D> shorts;
  V r[kImages][4];
  for (auto& of_image : r)
    for (V& each : of_image) each = hn::Zero(d);
  for (int k = stretch.begin; k < stretch.end; k += lanes()) {
    const Vector3 n = load3(lights.rho_n[c], k);
    const V rho = hn::Load(d, surface.albedo[c].at + k);
    for (size_t i = 0; i < kImages; ++i) {
      const std::uint16_t* codes = images[i]->codes[c] + k;
      fetch_next<1>(*images[i], codes);
      const V code = hn::ConvertTo(d, hn::PromoteTo(Ints(), hn::LoadU(shorts, codes)));
      r[i][0] = hn::MulAdd(code, n.x, r[i][0]);
      r[i][1] = hn::MulAdd(code, n.y, r[i][1]);
      r[i][2] = hn::MulAdd(code, n.z, r[i][2]);
      r[i][3] = hn::MulAdd(code, rho, r[i][3]);
    }
  }
  for (size_t i = 0; i < kImages; ++i)
    for (int j = 0; j < 4; ++j)
      b[i][c][j] = images[i]->least[c] * lights.rho_h[c][j] +
                   images[i]->step[c] * hn::GetLane(hn::SumOfLanes(d, r[i][j]));
}

void plain_light_rhs(const TileSurface& surface, const PlainLights& lights, const ImageChoice& choice,
                     Stretch stretch, float (*b)[3][4]) {
  for (int c = 0; c < 3; ++c) {
    for (int j = 0; j < choice.count; j += 2) {
      const int first = choice.which[j], second = choice.which[std::min(j + 1, choice.count - 1)];
      const TileImage* const images[2] = {choice.images + first, choice.images + second};
      float(*const to[2])[4] = {b[first], b[second]};
      if (j + 1 < choice.count)
        plain_rhs_of_channel<2>(surface, lights, images, c, stretch, to);
      else
        plain_rhs_of_channel<1>(surface, lights, images, c, stretch, to);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(plain_lights);

void plain_lights(const TileSurface& surface, Stretch stretch, PlainLights& lights) {
  HWY_DYNAMIC_DISPATCH(plain_lights)(surface, stretch, lights);
}

HWY_EXPORT(plain_light_rhs);

void plain_light_rhs(const TileSurface& surface, const PlainLights& lights, const ImageChoice& choice,
                     Stretch stretch, float (*b)[3][4]) {
  HWY_DYNAMIC_DISPATCH(plain_light_rhs)(surface, lights, choice, stretch, b);
}

}  // namespace rakelight::kernels
#endif
