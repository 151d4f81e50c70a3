// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/shading.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

/// Room light: first-order harmonics, brighter from above, a little warm.
Eigen::Vector3f ambient(const SimulateOptions& options, const Eigen::Vector3f& normal) {
  const auto level = static_cast<float>(options.lamps.ambient) * (0.75f - 0.25f * normal.y());
  return level * Eigen::Vector3f(1.1f, 1.0f, 0.85f);
}

/// Blinn-Phong lobe, 1 at its peak.
float lobe(const SurfaceSample& sample, const Eigen::Vector3f& to_lamp, double shininess) {
  const Eigen::Vector3f half = (to_lamp + sample.to_eye).normalized();
  return std::pow(std::max(0.0f, sample.hit.normal.dot(half)), static_cast<float>(shininess));
}

Eigen::Vector3f from_lamp(const ShadingContext& context, const SurfaceSample& sample, const LampTruth& lamp) {
  const ImageOptions& image = context.options.image;
  const Incident light = incident_light(lamp, context.object_center, sample.hit.position);
  const float cosine = sample.hit.normal.dot(light.direction);
  if (image.cast_shadows && cosine > 0 &&
      context.tracer.occluded(sample.hit, light.direction, light.distance)) {
    return Eigen::Vector3f::Zero();
  }
  // The harmonic approximation reaches past the terminator.
  const float shading = image.attached_shadows ? std::max(0.0f, cosine) : 0.75f * cosine + 0.25f;
  Eigen::Vector3f result = sample.albedo.cwiseProduct(light.irradiance) * shading;
  if (image.highlight > 0 && cosine > 0) {
    result += light.irradiance *
              (static_cast<float>(image.highlight) * lobe(sample, light.direction, image.shininess));
  }
  return result;
}

}  // namespace

Eigen::Vector3f radiance(const ShadingContext& context, const SurfaceSample& sample,
                         const std::vector<LampTruth>& lamps) {
  Eigen::Vector3f sum = sample.albedo.cwiseProduct(ambient(context.options, sample.hit.normal));
  for (const LampTruth& lamp : lamps) sum += from_lamp(context, sample, lamp);
  return sum;
}

}  // namespace rakelight
