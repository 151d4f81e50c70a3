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

void add_albedo_sums(const TileSurface& surface, const ImageChoice& choice, Stretch stretch,
                     AlbedoSums& sums) {
  const D d;
  for (int k = stretch.begin; k < stretch.end; k += lanes()) {
    const Vector3 n = load3(surface.normal, k);
    V SI[3], SS[3];
    for (int c = 0; c < 3; ++c) {
      SI[c] = hn::Load(d, sums.SI[c].at + k);
      SS[c] = hn::Load(d, sums.SS[c].at + k);
    }
    for_each_image(choice, [&](auto light, const TileImage& image, int) {
      light.move_to(surface, k, n);
      const V weight = load_weights(image, k);
      for (int c = 0; c < 3; ++c) {
        const V S = shading(light, c);
        const Samples samples(image, c, k);
        const V wS = hn::IfThenElseZero(samples.usable, hn::Mul(weight, S));
        SI[c] = hn::MulAdd(wS, samples.radiance, SI[c]);
        SS[c] = hn::MulAdd(wS, S, SS[c]);
      }
    });
    for (int c = 0; c < 3; ++c) {
      hn::Store(SI[c], d, sums.SI[c].at + k);
      hn::Store(SS[c], d, sums.SS[c].at + k);
    }
  }
}

void divide_albedo(const AlbedoSums& sums, Stretch stretch, TileSurface& surface) {
  const D d;
  const V least = hn::Set(d, 1e-8f);
  for (int c = 0; c < 3; ++c) {
    for (int k = stretch.begin; k < stretch.end; k += lanes()) {
      const V SI = hn::Load(d, sums.SI[c].at + k), SS = hn::Load(d, sums.SS[c].at + k);
      const V rho = hn::Max(hn::Zero(d), hn::Div(SI, SS)), old = hn::Load(d, surface.albedo[c].at + k);
      hn::Store(hn::IfThenElse(hn::Gt(SS, least), rho, old), d, surface.albedo[c].at + k);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(add_albedo_sums);

void add_albedo_sums(const TileSurface& surface, const ImageChoice& choice, Stretch stretch,
                     AlbedoSums& sums) {
  HWY_DYNAMIC_DISPATCH(add_albedo_sums)(surface, choice, stretch, sums);
}

HWY_EXPORT(divide_albedo);

void divide_albedo(const AlbedoSums& sums, Stretch stretch, TileSurface& surface) {
  HWY_DYNAMIC_DISPATCH(divide_albedo)(sums, stretch, surface);
}

}  // namespace rakelight::kernels
#endif
