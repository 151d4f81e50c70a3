// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "simulate/albedo.h"
#include "simulate/image_sensor.h"

namespace rakelight {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// The samples of pixel (u, v) that meet the object, on a regular grid of sub-pixels.
void sample_pixel(const ShadingContext& context, const Camera& camera, int u, int v,
                  std::vector<SurfaceSample>& samples) {
  samples.clear();
  const int n = context.options.image.samples;
  for (int k = 0; k < n * n; ++k) {
    const int column = k % n, row = k / n;
    const double du = (column + 0.5) / n - 0.5, dv = (row + 0.5) / n - 0.5;
    const Eigen::Vector3f ray = pixel_ray(camera, u + du, v + dv);
    if (const auto hit = context.tracer.trace(Eigen::Vector3f::Zero(), ray)) {
      const auto& scene = context.options.scene;
      samples.push_back(
          {*hit, albedo_at(scene.albedo, hit->texture, context.options.seed), -ray.normalized()});
    }
  }
}

/// Mean radiance of a pixel; rays that miss the object see black.
Eigen::Vector3f pixel_radiance(const ShadingContext& context, const std::vector<SurfaceSample>& samples,
                               const std::vector<LampTruth>& lamps) {
  const int n = context.options.image.samples;
  return total_radiance(context, samples, lamps) / static_cast<float>(n * n);
}

cv::Vec3f mean_albedo(const std::vector<SurfaceSample>& samples) {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const auto& sample : samples) mean += sample.albedo / static_cast<float>(samples.size());
  return {mean.x(), mean.y(), mean.z()};
}

void render_row(const ShadingContext& context, const Camera& camera, const std::vector<LampSet>& sets,
                const ImageSensor& sensor, int v, RenderedImages& out) {
  std::vector<SurfaceSample> samples;
  for (int u = 0; u < camera.width; ++u) {
    sample_pixel(context, camera, u, v, samples);
    for (std::size_t k = 0; k < sets.size(); ++k) {
      sensor.expose(pixel_radiance(context, samples, sets[k].lamps), static_cast<int>(k), {u, v},
                    out.colors[k]);
    }
    if (!samples.empty()) out.albedo(v, u) = mean_albedo(samples);
  }
}

/// Samples of neighbouring pixels of a row, with the pixels they belong to.
struct Tile {
  std::vector<SurfaceSample> samples;
  std::vector<int> columns;  ///< runs parallel to the samples
};

constexpr int kTilePixels =
    64;  // their shadow rays go together, and their samples stay in the processor's cache

void sample_tile(const ShadingContext& context, const Camera& camera, int first, int v, Tile& tile,
                 RadianceImages& out) {
  thread_local std::vector<SurfaceSample> samples;
  tile.samples.clear();
  tile.columns.clear();
  for (int u = first; u < std::min(first + kTilePixels, camera.width); ++u) {
    sample_pixel(context, camera, u, v, samples);
    if (samples.empty()) continue;
    out.albedo(v, u) = mean_albedo(samples);
    tile.samples.insert(tile.samples.end(), samples.begin(), samples.end());
    tile.columns.insert(tile.columns.end(), samples.size(), u);
  }
}

void render_radiance_row(const ShadingContext& context, const Camera& camera,
                         const std::vector<LampTruth>& lamps, int v, RadianceImages& out) {
  const float share =
      1.0f / static_cast<float>(context.options.image.samples * context.options.image.samples);
  const auto add = [share](const Eigen::Vector3f& radiance, cv::Vec3f& pixel) {
    for (int c = 0; c < 3; ++c) pixel[c] += share * radiance[c];
  };
  thread_local Tile tile;
  thread_local std::vector<Eigen::Vector3f> radiance;
  for (int first = 0; first < camera.width; first += kTilePixels) {
    sample_tile(context, camera, first, v, tile, out);
    if (tile.samples.empty()) continue;
    for (std::size_t i = 0; i < tile.samples.size(); ++i)
      add(ambient_radiance(context, tile.samples[i]), out.ambient(v, tile.columns[i]));
    for (std::size_t k = 0; k < lamps.size(); ++k) {
      lamp_radiance(context, tile.samples, lamps[k], radiance);
      for (std::size_t i = 0; i < radiance.size(); ++i) add(radiance[i], out.lamps[k](v, tile.columns[i]));
    }
  }
}

/// A lattice of about this many pixels stands for the image when the exposure is chosen.
constexpr int kMeteredPixels = 30000;

}  // namespace

Eigen::Vector3f pixel_ray(const Camera& camera, double u, double v) {
  return Eigen::Vector3d((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1).cast<float>();
}

double auto_exposure(const ShadingContext& context, const Camera& camera, const std::vector<LampSet>& sets) {
  const int step =
      std::max(1, static_cast<int>(std::sqrt(1.0 * camera.width * camera.height / kMeteredPixels)));
  std::vector<float> peaks;
  std::mutex mutex;
  cv::parallel_for_({0, (camera.height + step - 1) / step}, [&](const cv::Range& rows) {
    std::vector<SurfaceSample> samples;
    std::vector<float> found;
    for (int row = rows.start; row < rows.end; ++row) {
      for (int u = 0; u < camera.width; u += step) {
        sample_pixel(context, camera, u, row * step, samples);
        if (samples.empty()) continue;
        for (const auto& set : sets) {
          if (!set.lamps.empty()) found.push_back(pixel_radiance(context, samples, set.lamps).maxCoeff());
        }
      }
    }
    const std::lock_guard<std::mutex> lock(mutex);
    peaks.insert(peaks.end(), found.begin(), found.end());
  });
  if (peaks.empty()) return 1;
  const auto clipped =
      static_cast<std::size_t>(context.options.image.clip_share * static_cast<double>(peaks.size()));
  const auto nth = peaks.end() - 1 - static_cast<std::ptrdiff_t>(std::min(clipped, peaks.size() - 1));
  std::nth_element(peaks.begin(), nth, peaks.end());
  if (*nth <= 0) return 1;
  const double headroom = clipped == 0 ? 0.92 : 1.0;  // the lattice may have missed the brightest pixel
  return headroom / static_cast<double>(*nth);
}

RenderedImages render_images(const ShadingContext& context, const Camera& camera,
                             const std::vector<LampSet>& sets, double exposure, const RowProgress& progress) {
  const ImageSensor sensor(context.options, exposure);
  RenderedImages out;
  for (std::size_t k = 0; k < sets.size(); ++k) out.colors.push_back(sensor.blank(camera.size()));
  out.albedo = cv::Mat3f(camera.size(), cv::Vec3f(kNaN, kNaN, kNaN));
  constexpr int kRowsBetweenReports = 16;
  for (int first = 0; first < camera.height; first += kRowsBetweenReports) {
    const int last = std::min(first + kRowsBetweenReports, camera.height);
    cv::parallel_for_({first, last}, [&](const cv::Range& rows) {
      for (int v = rows.start; v < rows.end; ++v) render_row(context, camera, sets, sensor, v, out);
    });
    progress(static_cast<double>(last) / camera.height);
  }
  return out;
}

RadianceImages render_radiance(const ShadingContext& context, const Camera& camera,
                               const std::vector<LampTruth>& lamps) {
  RadianceImages out{
      cv::Mat3f(camera.size(), cv::Vec3f()), {}, cv::Mat3f(camera.size(), cv::Vec3f(kNaN, kNaN, kNaN))};
  for (std::size_t k = 0; k < lamps.size(); ++k) out.lamps.emplace_back(camera.size(), cv::Vec3f());
  cv::parallel_for_({0, camera.height}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) render_radiance_row(context, camera, lamps, v, out);
  });
  return out;
}

SurfaceMaps render_surface(const RayTracer& tracer, const Camera& camera) {
  SurfaceMaps maps{cv::Mat1f(camera.size(), kNaN), cv::Mat3f(camera.size(), cv::Vec3f(kNaN, kNaN, kNaN))};
  cv::parallel_for_({0, camera.height}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const auto hit = tracer.trace(Eigen::Vector3f::Zero(), pixel_ray(camera, u, v));
        if (!hit) continue;
        maps.depth(v, u) = hit->position.z();
        maps.normals(v, u) = {hit->normal.x(), hit->normal.y(), hit->normal.z()};
      }
    }
  });
  return maps;
}

}  // namespace rakelight
