// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/image_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/cauchy_weight.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

void cauchy_weight(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, float scale,
                   TileRow& weight) {
  with_light(lamp, [&](auto light) {
    const D d;
    const V least = hn::Set(d, lamp.least), inverse_square = hn::Set(d, 1.0f / (scale * scale));
    const V none = hn::Zero(d), one = hn::Set(d, 1.0f);
    for (int k = 0; k < kTilePixels; k += lanes()) {
      light.move_to(surface, k, load3(surface.normal, k));
      V squares = none, channels = none;
      for (int c = 0; c < 3; ++c) {
        const V model = hn::Mul(hn::Load(d, surface.albedo[c].at + k), shading(light, c, least));
        const Samples samples(image, c, k);
        const V r = hn::IfThenElseZero(samples.usable, hn::Sub(model, samples.radiance));
        squares = hn::MulAdd(r, r, squares);
        channels = hn::Add(channels, hn::IfThenElseZero(samples.usable, one));
      }
      const V bounded = hn::Div(channels, hn::MulAdd(squares, inverse_square, hn::Max(channels, one)));
      hn::Store(bounded, d, weight.at + k);
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(cauchy_weight);

void cauchy_weight(const TileSurface& surface, const TileLamp& lamp, const TileImage& image, float scale,
                   TileRow& weight) {
  HWY_DYNAMIC_DISPATCH(cauchy_weight)(surface, lamp, image, scale, weight);
}

}  // namespace rakelight::kernels
#endif
