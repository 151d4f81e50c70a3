// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/image_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/albedo_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/lamp_light-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

void add_albedo_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                     TileRow (&SI)[3], TileRow (&SS)[3]) {
  with_light(lamp, [&](auto light) {
    const D d;
    const V least = hn::Set(d, lamp.least);
    for (int k = 0; k < kTilePixels; k += lanes()) {
      light.move_to(surface, k, load3(surface.normal, k));
      const V weight = hn::LoadU(d, image.weight + k);
      for (int c = 0; c < 3; ++c) {
        const V S = shading(light, c, least);
        const Samples samples(image, c, k);
        const V wS = hn::IfThenElseZero(samples.usable, hn::Mul(weight, S));
        hn::Store(hn::MulAdd(wS, samples.radiance, hn::Load(d, SI[c].at + k)), d, SI[c].at + k);
        hn::Store(hn::MulAdd(wS, S, hn::Load(d, SS[c].at + k)), d, SS[c].at + k);
      }
    }
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(add_albedo_sums);

void add_albedo_sums(const TileSurface& surface, const TileLamp& lamp, const TileImage& image,
                     TileRow (&SI)[3], TileRow (&SS)[3]) {
  HWY_DYNAMIC_DISPATCH(add_albedo_sums)(surface, lamp, image, SI, SS);
}

}  // namespace rakelight::kernels
#endif
