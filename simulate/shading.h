// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reflected light of a surface point: Lambert, Blinn-Phong, shadows.
#pragma once

#include <vector>

#include "simulate/lamps.h"
#include "simulate/ray_tracer.h"

namespace rakelight {

/// A point that is seen, with its paint.
struct SurfaceSample {
  SurfaceHit hit;
  Eigen::Vector3f albedo;  ///< linear RGB
  Eigen::Vector3f to_eye;  ///< unit
};

/// What all points of a scan share.
struct ShadingContext {
  const SimulateOptions& options;
  const RayTracer& tracer;
  Eigen::Vector3f object_center;
};

/// Sums over the samples of the linear radiance towards the eye; 1 = a facing white surface under a lamp of strength 1.
/// Under the room's ambient light alone, under one lamp alone, under both.
Eigen::Vector3f ambient_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples);
Eigen::Vector3f lamp_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                              const LampTruth& lamp);
Eigen::Vector3f total_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                               const std::vector<LampTruth>& lamps);

}  // namespace rakelight
