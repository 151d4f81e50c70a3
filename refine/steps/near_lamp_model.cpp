// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/near_lamp_model.h"

namespace rakelight {
namespace {

constexpr float kLeastShading = 1e-12f;  // below, in squares: nothing is known of a pixel's albedo

/// S of image i.
void shade(const Lamp& lamp, const LampScene& scene, const SurfacePoints& surface, size_t i,
           Eigen::ArrayXXf& S) {
  const Eigen::ArrayXf incidence =
      lamp.near ? near_incidence(lamp, scene, surface) : Eigen::ArrayXf(Eigen::Index{0});
  for (int c = 0; c < 3; ++c) {
    auto column = S.col(sample_column(i, c));
    if (lamp.near)
      column = lamp.strength[c] * incidence + lamp.phi[c];
    else
      column = (lamp.l(c, 0) * surface.normal.col(0) + lamp.l(c, 1) * surface.normal.col(1) +
                lamp.l(c, 2) * surface.normal.col(2))
                   .max(0.0f) +
               lamp.phi[c];
  }
}

}  // namespace

SurfacePoints moved_surface(const NearLampUnknowns& at, const LampRegion& region) {
  const Eigen::Matrix<float, kBroadChanges, 1> c = at.shape.cast<float>();
  SurfacePoints moved = region.surface;
  const Eigen::ArrayXf stretch = (region.B.matrix() * c).array().exp();
  for (int axis = 0; axis < 3; ++axis) {
    moved.point.col(axis) *= stretch;
    moved.normal.col(axis) +=
        (region.normal_by_c.middleCols<kBroadChanges>(Eigen::Index{kBroadChanges} * axis).matrix() * c)
            .array();
  }
  const Eigen::ArrayXf inverse_length = moved.normal.square().rowwise().sum().rsqrt();
  for (int axis = 0; axis < 3; ++axis) moved.normal.col(axis) *= inverse_length;
  return moved;
}

RegionModel::RegionModel(const NearLampUnknowns& at, const LampRegion& region, const SurfacePoints& surface)
    : S(region.samples->rows(), region.w.cols()),
      matt(region.samples->I),
      SS(Eigen::ArrayX3f::Zero(S.rows(), 3)),
      rho(SS) {
  for (size_t i = 0; i < at.lamps.size(); ++i) {
    const Lamp& lamp = at.lamps[i];
    shade(lamp, at.scene, surface, i, S);
    const auto lobe =
        region.lobes.middleCols<kHighlightLobes>(kHighlightLobes * static_cast<Eigen::Index>(i));
    const Eigen::ArrayXf highlight = (lobe.matrix() * at.gloss.cast<float>()).array();
    for (int c = 0; c < 3; ++c) {
      const Eigen::Index column = sample_column(i, c);
      matt.col(column) -= lamp.strength[c] * highlight;
      SS.col(c) += region.w.col(column) * S.col(column).square();
      rho.col(c) += region.w.col(column) * S.col(column) * matt.col(column);
    }
  }
  rho = (SS > kLeastShading && rho > 0.0f).select(rho / SS, 0.0f);
}

ShadingDerivatives shading_derivatives(const Lamp& lamp, const LampScene& scene, const LampRegion& region,
                                       const SurfacePoints& surface) {
  ShadingDerivatives by(surface.rows(), kDerivatives);
  kernels::BroadRuns broad{};
  kernels::NearDerivatives out{};
  out.value = by.col(kValue).data();
  for (Eigen::Index k = 0; k < 3; ++k) {
    out.place[k] = by.col(kByPlace + k).data();
    out.aim[k] = by.col(kByShared + k).data();
  }
  for (Eigen::Index c = 0; c < kBroadChanges; ++c) {
    out.shape[c] = by.col(kByShared + NearLampUnknowns::kAim + c).data();
    broad.B[c] = region.B.col(c).data();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      broad.normal_by_c[axis][c] = region.normal_by_c.col(kBroadChanges * axis + c).data();
  }
  kernels::near_derivatives(near_light(lamp, scene), surface.runs(), broad, surface.rows(), out);
  return by;
}

}  // namespace rakelight
