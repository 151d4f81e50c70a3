// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/albedo.h"

#include "refine/pixel_blocks.h"

namespace rakelight {

Eigen::Matrix3Xf estimate_albedo(const Observations& images, const SurfaceState& state) {
  Eigen::Matrix3Xf albedo = state.albedo;
  for_each_block(images.pixels, [&](int begin, int end) {
    Eigen::Matrix3Xf numerator = Eigen::Matrix3Xf::Zero(3, end - begin);
    Eigen::Matrix3Xf denominator = numerator;
    for (int i = 0; i < images.images; ++i) {
      const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
      const float* weight = state.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels);
      for (int p = begin; p < end; ++p) {
        const LocalLight light = light_at(lamp, state.points.col(p), state.scene);
        const Eigen::Vector3f S = shading(light, state.normals.col(p), state.attached_shadows);
        const Eigen::Vector3f I(images.channel(i, 0)[p], images.channel(i, 1)[p], images.channel(i, 2)[p]);
        const Eigen::Vector3f w = weight[p] * images.usable_channels(i, p);
        numerator.col(p - begin) += w.cwiseProduct(S).cwiseProduct(I);
        denominator.col(p - begin) += w.cwiseProduct(S.cwiseAbs2());
      }
    }
    for (int p = begin; p < end; ++p) {
      for (int c = 0; c < 3; ++c) {
        const float squares = denominator(c, p - begin);
        if (squares > 1e-8f) albedo(c, p) = std::max(0.0f, numerator(c, p - begin) / squares);
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
      lamp.phi[c] *= mean;
      lamp.strength[c] *= mean;
    }
  }
}

}  // namespace rakelight
