// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/depth_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/depth_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <hwy/contrib/math/math-inl.h>

#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>;
using VF = hn::Vec<Floats>;

constexpr int kMostLanes = 8;

/// The values, `rest` of them where these are fewer than a vector.
HWY_INLINE hn::Vec<Doubles> load_some(const double* values, int rest) {
  const Doubles d;
  if (rest >= static_cast<int>(hn::Lanes(d))) return hn::LoadU(d, values);
  HWY_ALIGN double some[kMostLanes] = {};
  std::copy_n(values, rest, some);
  return hn::Load(d, some);
}

void ray_points(const RayRun& rays, const double* zeta, double origin, float scale, float* points) {
  const Doubles d;
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto from = hn::Set(d, origin);
  const VF x0 = hn::Set(f, rays.x), y = hn::Set(f, rays.y), step = hn::Set(f, rays.step);
  for (int i = 0; i < rays.count; i += lanes) {
    const VF turn = hn::DemoteTo(f, hn::Sub(load_some(zeta + i, rays.count - i), from));
    const VF z = hn::Mul(hn::Set(f, scale), hn::Exp(f, turn));
    const VF x = hn::MulAdd(hn::Iota(f, static_cast<float>(i)), step, x0);
    if (rays.count - i >= lanes) {
      hn::StoreInterleaved3(hn::Mul(x, z), hn::Mul(y, z), z, f, points + 3 * i);
      continue;
    }
    HWY_ALIGN float rest[3 * kMostLanes];
    hn::StoreInterleaved3(hn::Mul(x, z), hn::Mul(y, z), z, f, rest);
    std::copy_n(rest, 3 * (rays.count - i), points + 3 * i);
  }
}

double squared_depth_change(const double* before, const double* after, int count) {
  const Doubles d;
  const Floats f;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto half = hn::Set(d, 0.5);
  VF sum = hn::Zero(f);
  for (int i = 0; i < count; i += lanes) {
    const auto a = load_some(before + i, count - i), b = load_some(after + i, count - i);
    const VF z = hn::Exp(f, hn::DemoteTo(f, hn::Mul(half, hn::Add(a, b))));
    const VF change = hn::Mul(z, hn::DemoteTo(f, hn::Sub(b, a)));
    sum = hn::MulAdd(change, change, sum);
  }
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(f, sum)));
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(ray_points);
HWY_EXPORT(squared_depth_change);

void ray_points(const RayRun& rays, const double* zeta, double origin, float scale, float* points) {
  HWY_DYNAMIC_DISPATCH(ray_points)(rays, zeta, origin, scale, points);
}

double squared_depth_change(const double* before, const double* after, int count) {
  return HWY_DYNAMIC_DISPATCH(squared_depth_change)(before, after, count);
}

}  // namespace rakelight::kernels
#endif
