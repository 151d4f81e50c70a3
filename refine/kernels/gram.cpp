// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/kernels/gram.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "refine/kernels/gram.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "refine/kernels/vector3-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rakelight::kernels {
namespace HWY_NAMESPACE {

/// Products of the four runs from a with the four from b: sixteen sums stay in registers while eight runs go by.
HWY_INLINE void gram_block(const float* a, const float* b, std::ptrdiff_t stride, int count, int runs,
                           float* out) {
  const D d;
  V sums[kGramRuns][kGramRuns];
  for (auto& row : sums)
    for (V& each : row) each = hn::Zero(d);
  for (int k = 0; k < count; k += lanes()) {
    V right[kGramRuns];
    for (int j = 0; j < kGramRuns; ++j) right[j] = hn::LoadU(d, b + j * stride + k);
    for (int i = 0; i < kGramRuns; ++i) {
      const V left = hn::LoadU(d, a + i * stride + k);
      for (int j = 0; j < kGramRuns; ++j) sums[i][j] = hn::MulAdd(left, right[j], sums[i][j]);
    }
  }
  for (int j = 0; j < kGramRuns; ++j)
    for (int i = 0; i < kGramRuns; ++i) out[i + runs * j] = hn::GetLane(hn::SumOfLanes(d, sums[i][j]));
}

void gram(const float* values, std::ptrdiff_t stride, int runs, int count, float* out) {
  for (int b = 0; b < runs; b += kGramRuns)
    for (int a = b; a < runs; a += kGramRuns)
      gram_block(values + a * stride, values + b * stride, stride, count, runs,
                 out + a + static_cast<std::ptrdiff_t>(runs) * b);
}

}  // namespace HWY_NAMESPACE
}  // namespace rakelight::kernels
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rakelight::kernels {
HWY_EXPORT(gram);

void gram(const float* values, std::ptrdiff_t stride, int runs, int count, float* out) {
  HWY_DYNAMIC_DISPATCH(gram)(values, stride, runs, count, out);
}

}  // namespace rakelight::kernels
#endif
