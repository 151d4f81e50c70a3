// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo.h"

#include "refine/lamp_shading.h"

namespace rakelight {

Eigen::Matrix3Xf estimate_albedo(const Observations& images, const SurfaceState& state) {
  Eigen::Matrix3Xf albedo = state.albedo;
  for_each_block(images.pixels, [&](int begin, int end) {
    const int count = end - begin;
    Eigen::ArrayX3f numerator = Eigen::ArrayX3f::Zero(count, 3), denominator = numerator;
    ShadingBlock model;
    for (int i = 0; i < images.images; ++i) {
      shade(state.lamps[static_cast<size_t>(i)], state, begin, end, model);
      const float* weight =
          state.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels) + begin;
      for (int c = 0; c < 3; ++c) {
        const float* S = model.S[static_cast<size_t>(c)].data();
        const float* I = images.channel(i, c) + begin;
        const unsigned char* usable = images.usable_in(i, c) + begin;
        float *sum_SI = numerator.col(c).data(), *sum_SS = denominator.col(c).data();
        for (int k = 0; k < count; ++k) {
          const float wS = weight[k] * static_cast<float>(usable[k]) * S[k];
          sum_SI[k] += wS * I[k];
          sum_SS[k] += wS * S[k];
        }
      }
    }
    for (int k = 0; k < count; ++k) {
      for (int c = 0; c < 3; ++c) {
        if (denominator(k, c) > 1e-8f)
          albedo(c, begin + k) = std::max(0.0f, numerator(k, c) / denominator(k, c));
      }
    }
  });
  return albedo;
}

void normalize_albedo(SurfaceState& state) {
  for (int c = 0; c < 3; ++c) {
    const float mean = static_cast<float>(state.albedo.row(c).cast<double>().mean());
    if (!(mean > 0.0f)) continue;
    state.albedo.row(c) /= mean;
    for (Lamp& lamp : state.lamps) {
      lamp.l.row(c) *= mean;
      lamp.Q[static_cast<size_t>(c)] *= mean;
      lamp.phi[c] *= mean;
      lamp.strength[c] *= mean;
    }
  }
}

}  // namespace rakelight
