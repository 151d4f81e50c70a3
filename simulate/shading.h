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

/// Linear radiance of a sample towards the eye under the room's ambient light alone; 1 = a facing white surface under a
/// lamp of strength 1.
Eigen::Vector3f ambient_radiance(const ShadingContext& context, const SurfaceSample& sample);

/// The same of each sample under one lamp alone, its cast shadows included. Neighbouring samples together are fastest.
void lamp_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                   const LampTruth& lamp, std::vector<Eigen::Vector3f>& radiance);

/// Sum over the samples of the radiance under the ambient light and all lamps.
Eigen::Vector3f total_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                               const std::vector<LampTruth>& lamps);

}  // namespace rakelight
