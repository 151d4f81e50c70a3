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

/// Light reflected by a point that the lamp reaches unhindered.
Eigen::Vector3f reflected(const ImageOptions& image, const SurfaceSample& sample, const Incident& light) {
  const float cosine = sample.hit.normal.dot(light.direction);
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

Eigen::Vector3f ambient_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const SurfaceSample& sample : samples) {
    sum += sample.albedo.cwiseProduct(ambient(context.options, sample.hit.normal));
  }
  return sum;
}

/// The lamp's cast shadow takes samples out.
Eigen::Vector3f lamp_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                              const LampTruth& lamp) {
  thread_local std::vector<ShadowRay> rays;
  thread_local std::vector<Eigen::Vector3f> lit;  // runs parallel to `rays`
  thread_local std::vector<bool> occluded;
  rays.clear();
  lit.clear();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const SurfaceSample& sample : samples) {
    const Incident light = incident_light(lamp, context.object_center, sample.hit.position);
    const Eigen::Vector3f value = reflected(context.options.image, sample, light);
    if (context.options.image.cast_shadows && sample.hit.normal.dot(light.direction) > 0) {
      rays.push_back({&sample.hit, light.direction, light.distance});
      lit.push_back(value);
    } else {
      sum += value;
    }
  }
  if (rays.empty()) return sum;
  context.tracer.find_occluded(rays, occluded);
  for (std::size_t k = 0; k < lit.size(); ++k) {
    if (!occluded[k]) sum += lit[k];
  }
  return sum;
}

Eigen::Vector3f total_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                               const std::vector<LampTruth>& lamps) {
  Eigen::Vector3f sum = ambient_radiance(context, samples);
  for (const LampTruth& lamp : lamps) sum += lamp_radiance(context, samples, lamp);
  return sum;
}

}  // namespace rakelight
