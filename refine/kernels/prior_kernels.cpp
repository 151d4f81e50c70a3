// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/prior_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/prior_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, 8>;
using Floats = hn::Rebind<float, Doubles>;
using VD = hn::Vec<Doubles>;

/// Adds up run.count pixels' energy; with kAdd their equations, too.
template <class Tag, bool kCells, bool kAdd>
HWY_INLINE hn::Vec<Tag> prior_at(Tag d, const PriorRun& run, int i, float* diagonal, float* rhs) {
  const hn::Rebind<float, Tag> f;
  using VT = hn::Vec<Tag>;
  const VT floor = hn::Set(d, run.floor), zeta = hn::LoadU(d, run.zeta + i);
  const VT back = hn::Sub(hn::LoadU(d, run.start + i), zeta);
  VT more = floor, pull = hn::Mul(floor, back), energy = hn::Mul(pull, back);
  if constexpr (kCells) {
    const VT weight = hn::LoadU(d, run.weight + i), miss = hn::Sub(hn::LoadU(d, run.target + i), zeta);
    const VT of_cell = hn::Mul(weight, miss);
    energy = hn::MulAdd(of_cell, miss, energy);
    more = hn::Add(more, weight);
    pull = hn::Add(pull, of_cell);
  }
  if constexpr (kAdd) {
    hn::StoreU(hn::Add(hn::LoadU(f, diagonal + i), hn::DemoteTo(f, more)), f, diagonal + i);
    hn::StoreU(hn::Add(hn::LoadU(f, rhs + i), hn::DemoteTo(f, pull)), f, rhs + i);
  }
  return energy;
}

template <bool kCells, bool kAdd>
HWY_INLINE double prior_over(const PriorRun& run, int count, float* diagonal, float* rhs) {
  const Doubles d;
  const hn::CappedTag<double, 1> one;
  const int lanes = static_cast<int>(hn::Lanes(d));
  VD sum = hn::Zero(d);
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    sum = hn::Add(sum, prior_at<Doubles, kCells, kAdd>(d, run, i, diagonal, rhs));
  auto rest = hn::Zero(one);
  for (; i < count; ++i)
    rest = hn::Add(rest, prior_at<hn::CappedTag<double, 1>, kCells, kAdd>(one, run, i, diagonal, rhs));
  return hn::GetLane(hn::SumOfLanes(d, sum)) + hn::GetLane(rest);
}

double prior_energy(const PriorRun& run, bool cells, int count) {
  return cells ? prior_over<true, false>(run, count, nullptr, nullptr)
               : prior_over<false, false>(run, count, nullptr, nullptr);
}

double add_prior(const PriorRun& run, bool cells, int count, float* diagonal, float* rhs) {
  return cells ? prior_over<true, true>(run, count, diagonal, rhs)
               : prior_over<false, true>(run, count, diagonal, rhs);
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(prior_energy);
HWY_EXPORT(add_prior);

double prior_energy(const PriorRun& run, bool cells, int count) {
  return HWY_DYNAMIC_DISPATCH(prior_energy)(run, cells, count);
}

double add_prior(const PriorRun& run, bool cells, int count, float* diagonal, float* rhs) {
  return HWY_DYNAMIC_DISPATCH(add_prior)(run, cells, count, diagonal, rhs);
}

}  // namespace rakelight::kernels
#endif
