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

/// Blinn-Phong lobe x^s, 1 at its peak; nothing where it is under e^-18, far below what 16 bits tell apart.
float lobe(const SurfaceSample& sample, const Eigen::Vector3f& to_lamp, double shininess) {
  const Eigen::Vector3f half = (to_lamp + sample.to_eye).normalized();
  const float x = sample.hit.normal.dot(half), s = static_cast<float>(shininess);
  if (s * (x - 1) < -18) return 0;  // ln x <= x - 1, so that x^s < e^-18
  return std::pow(std::max(0.0f, x), s);
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

Eigen::Vector3f ambient_radiance(const ShadingContext& context, const SurfaceSample& sample) {
  return sample.albedo.cwiseProduct(ambient(context.options, sample.hit.normal));
}

void lamp_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                   const LampTruth& lamp, std::vector<Eigen::Vector3f>& radiance) {
  thread_local std::vector<ShadowRay> rays;
  thread_local std::vector<std::size_t> sample_of_ray;
  thread_local std::vector<bool> occluded;
  rays.clear();
  sample_of_ray.clear();
  radiance.clear();
  for (const SurfaceSample& sample : samples) {
    const Incident light = incident_light(lamp, context.object_center, sample.hit.position);
    if (context.options.image.cast_shadows && sample.hit.normal.dot(light.direction) > 0) {
      rays.push_back({&sample.hit, light.direction, light.distance});
      sample_of_ray.push_back(radiance.size());
    }
    radiance.push_back(reflected(context.options.image, sample, light));
  }
  if (rays.empty()) return;
  context.tracer.find_occluded(rays, occluded);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    if (occluded[k]) radiance[sample_of_ray[k]].setZero();
  }
}

Eigen::Vector3f total_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                               const std::vector<LampTruth>& lamps) {
  thread_local std::vector<Eigen::Vector3f> radiance;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const SurfaceSample& sample : samples) sum += ambient_radiance(context, sample);
  for (const LampTruth& lamp : lamps) {
    lamp_radiance(context, samples, lamp, radiance);
    for (const Eigen::Vector3f& value : radiance) sum += value;
  }
  return sum;
}

}  // namespace rakelight
