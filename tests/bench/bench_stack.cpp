// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bench/bench_stack.h"

#include <cmath>
#include <opencv2/core/utility.hpp>

namespace rakelight::bench {
namespace {

constexpr double kDistance = 1.0, kWave = 0.01;  // metres
constexpr double kWaves = 9;                     // over the width

/// Depth and its slopes at (x, y), all in metres.
struct Surface {
  double z, zx, zy;
};

Surface surface_at(double x, double y) {
  const double k = 2 * CV_PI * kWaves;
  return {kDistance + kWave * std::sin(k * x) * std::cos(k * y),
          kWave * k * std::cos(k * x) * std::cos(k * y), -kWave * k * std::sin(k * x) * std::sin(k * y)};
}

/// Noise of deviation about 1 from the pixel's number alone.
double noise_at(std::uint64_t number) {
  number = (number + 1) * 0x9E3779B97F4A7C15ull;
  number = (number ^ (number >> 29)) * 0xBF58476D1CE4E5B9ull;
  return (static_cast<double>((number >> 40) & 0xFFFF) / 65536.0 - 0.5) * std::sqrt(12.0);
}

Eigen::Vector3d lamp_direction(int lamp, int lamps) {
  const double angle = 2 * CV_PI * lamp / lamps;
  return Eigen::Vector3d(0.6 * std::cos(angle), 0.6 * std::sin(angle), -0.8);
}

}  // namespace

LightStack wavy_stack(int width, int height, int images) {
  LightStack stack;
  stack.color_camera = stack.depth_camera = {
      width, height, 1.0 * width, 1.0 * width, (width - 1) / 2.0, (height - 1) / 2.0, {}};
  stack.depth_unit_m = 1e-4;
  stack.mask = cv::Mat1b(height, width, uchar{255});
  for (int i = 0; i < images; ++i) {
    Light light;
    light.id = "lamp-" + std::to_string(i);
    stack.lights.push_back(light);
    Frame frame;
    frame.index = i;
    frame.light = light.id;
    frame.color = cv::Mat3b(height, width);
    if (i == 0) frame.depth = cv::Mat1w(height, width);
    stack.frames.push_back(frame);
  }
  cv::parallel_for_(cv::Range(0, height), [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      for (int u = 0; u < width; ++u) {
        const Surface at =
            surface_at((u - stack.color_camera.cx) / width, (v - stack.color_camera.cy) / width);
        const Eigen::Vector3d n = Eigen::Vector3d(at.zx, at.zy, -1).normalized();
        const auto pixel =
            static_cast<std::uint64_t>(v) * static_cast<std::uint64_t>(width) + static_cast<std::uint64_t>(u);
        stack.frames[0].depth(v, u) =
            static_cast<std::uint16_t>(std::lround((at.z + 0.002 * noise_at(pixel)) / stack.depth_unit_m));
        const double albedo = 0.6 + 0.2 * std::sin(0.05 * u) * std::sin(0.07 * v);
        for (int i = 0; i < images; ++i) {
          const double radiance = albedo * (0.9 * std::max(0.0, lamp_direction(i, images).dot(n)) + 0.05);
          auto& value = stack.frames[static_cast<size_t>(i)].color.at<cv::Vec3b>(v, u);
          for (int c = 0; c < 3; ++c)
            value[c] = cv::saturate_cast<uchar>(
                255 * (radiance * (1 - 0.1 * c)) +
                noise_at(3 * (pixel * 131 + static_cast<std::uint64_t>(i)) + static_cast<std::uint64_t>(c)));
        }
      }
    }
  });
  return stack;
}

}  // namespace rakelight::bench
