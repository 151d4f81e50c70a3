// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Surfaces whose depth, normals and points are known in closed form, and the images that a lamp model makes of them.
#pragma once

#include <algorithm>
#include <cmath>

#include "refine/observations.h"
#include "refine/steps/robust_weights.h"
#include "refine/surface_state.h"

namespace rakelight::test {

struct ExactSurface {
  PixelGrid grid;
  Eigen::VectorXd zeta;
  Eigen::Matrix3Xf normals, points;
};

/// A sphere of radius 0.2 m, its centre at 1 m, by a camera of side x side pixels; pixels tilted by less than 72 degrees.
inline ExactSurface exact_sphere(int side = 48) {
  const double radius = 0.2, middle = 0.5 * (side - 1);
  const Camera camera{side, side, 2.0 * side, 2.1 * side, middle, middle, {}};
  const Eigen::Vector3d center(0, 0, 1);
  const auto hit = [&](int u, int v) -> double {  // depth where the ray meets the sphere, 0 if it does not
    const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
    const double along = ray.dot(center), root = along * along - ray.dot(ray) * (1 - radius * radius);
    const double z = root > 0 ? (along - std::sqrt(root)) / ray.dot(ray) : 0;
    return z > 0 && (z - 1) / radius < -0.3 ? z : 0;
  };
  cv::Mat1b mask(side, side, uchar{0});
  for (int v = 0; v < side; ++v)
    for (int u = 0; u < side; ++u)
      if (hit(u, v) > 0) mask(v, u) = 255;
  ExactSurface surface;
  surface.grid = make_pixel_grid(camera, mask);
  surface.zeta.resize(surface.grid.size());
  for (int p = 0; p < surface.grid.size(); ++p) {
    const cv::Point at = surface.grid.pixels[static_cast<size_t>(p)];
    surface.zeta[p] = std::log(hit(at.x, at.y));
  }
  surface.points = surface_points(surface.grid, surface.zeta);
  surface.normals = (surface.points.colwise() - center.cast<float>()).colwise().normalized();
  return surface;
}

/// Albedo that differs from pixel to pixel and channel to channel, 0.2 to 1.
inline Eigen::Matrix3Xf varied_albedo(const ExactSurface& surface) {
  Eigen::Matrix3Xf albedo(3, surface.grid.size());
  for (int p = 0; p < surface.grid.size(); ++p) {
    const auto t = static_cast<float>(p);
    albedo.col(p) << 0.6f + 0.4f * std::sin(t), 0.6f + 0.4f * std::cos(0.7f * t),
        0.6f + 0.4f * std::sin(1.3f * t);
  }
  return albedo;
}

/// A far lamp whose channels differ in direction and strength.
inline Lamp far_lamp(float x, float y) {
  Lamp lamp;
  lamp.l.row(0) << x, y, -0.8f;
  lamp.l.row(1) << 0.9f * x, y + 0.05f, -0.7f;
  lamp.l.row(2) << x - 0.05f, 0.8f * y, -0.6f;
  lamp.phi << 0.1f, 0.08f, 0.05f;
  return lamp;
}

inline std::vector<Lamp> far_lamps() {
  return {far_lamp(0.5f, 0.0f), far_lamp(0.0f, 0.5f), far_lamp(-0.5f, 0.1f), far_lamp(0.1f, -0.6f),
          far_lamp(0, 0)};
}

/// The same with second-order harmonics.
inline std::vector<Lamp> second_order_lamps() {
  std::vector<Lamp> lamps = far_lamps();
  for (size_t i = 0; i < lamps.size(); ++i) {
    lamps[i].second_order = true;
    for (size_t c = 0; c < 3; ++c) {
      const float a = 0.05f * static_cast<float>(i + 1), b = 0.04f * static_cast<float>(c + 1), d = 0.1f - a;
      lamps[i].Q[c] << a, d, b, d, b, a, b, a, -a - b;
    }
  }
  return lamps;
}

/// The truth as a state: every sample fully trusted.
inline SurfaceState exact_state(const ExactSurface& surface, const Eigen::Matrix3Xf& albedo,
                                const std::vector<Lamp>& lamps, bool attached_shadows) {
  SurfaceState state;
  state.zeta = surface.zeta;
  state.normals = surface.normals;
  state.points = surface.points;
  state.albedo = albedo;
  state.lamps = lamps;
  state.scene.center = surface.points.rowwise().mean();
  state.attached_shadows = attached_shadows;
  state.weight.assign(lamps.size() * static_cast<size_t>(surface.grid.size()), 1.0f);
  return state;
}

/// Index of a sample in PlainSamples.
inline size_t sample_index(const Observations& images, int image, int channel, int pixel) {
  return (static_cast<size_t>(image) * 3 + static_cast<size_t>(channel)) *
             static_cast<size_t>(images.pixels) +
         static_cast<size_t>(pixel);
}

/// The images that the state's own model predicts: residual 0 everywhere.
inline Observations images_of(const SurfaceState& state) {
  Observations images(static_cast<int>(state.zeta.size()), static_cast<int>(state.lamps.size()));
  PlainSamples samples = images.plain();
  std::fill(samples.usable.begin(), samples.usable.end(), static_cast<unsigned char>(1));
  for (int i = 0; i < images.images; ++i) {
    for (int p = 0; p < images.pixels; ++p) {
      const Eigen::Vector3f n = state.normals.col(p);
      const LocalLight light =
          light_at(state.lamps[static_cast<size_t>(i)], state.points.col(p), n, state.scene);
      const Eigen::Vector3f S = shading(light, n, state.attached_shadows);
      for (int c = 0; c < 3; ++c) samples.radiance[sample_index(images, i, c, p)] = state.albedo(c, p) * S[c];
    }
    images.light_ids.push_back("lamp-" + std::to_string(i));
    images.frame_index.push_back(i);
    images.colored_lamps.push_back(false);
    images.lamp_positions.emplace_back();
  }
  images.set(samples);
  return images;
}

/// Changes the images' samples as numbers.
template <class Change>
void change_samples(Observations& images, const Change& change) {
  PlainSamples samples = images.plain();
  change(samples);
  images.set(samples);
}

}  // namespace rakelight::test
