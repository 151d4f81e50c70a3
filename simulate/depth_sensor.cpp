// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/depth_sensor.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "simulate/counter_random.h"
#include "simulate/render.h"

namespace rakelight {
namespace {

enum Stream : std::uint64_t { kFixed = 401, kShiftX, kShiftY, kRagged, kDrift = 1000, kWhite = 100000 };

constexpr double kReferenceWidth = 640;  // of the grid that options in pixels refer to
constexpr double kEdgeShiftPx = 0.6;     // matching windows move depth edges by about this much
constexpr double kGrazingCosine = 0.17;  // below, the pattern is too stretched to be matched (80 degrees)
constexpr double kJump = 0.02;           // relative step of depth that counts as an edge

bool reads(const DepthSensorOptions& sensor, const RayTracer& tracer, const SurfaceHit& hit, float ragged) {
  if (!sensor.holes) return true;
  const double cosine = -static_cast<double>(hit.normal.dot(hit.position.normalized()));
  if (cosine < kGrazingCosine + 0.05 * static_cast<double>(ragged)) return false;
  const Eigen::Vector3f to_projector =
      Eigen::Vector3f(static_cast<float>(sensor.baseline_m), 0, 0) - hit.position;
  const float distance = to_projector.norm();
  std::vector<bool> occluded;
  tracer.find_occluded({{&hit, to_projector / distance, distance}}, occluded);
  return !occluded.front();
}

/// Readings fail beside depth jumps, raggedly.
void drop_edges(cv::Mat1f& disparity, const cv::Mat1f& ragged) {
  cv::Mat1f nearest, farthest;
  cv::Mat1f filled;
  cv::max(disparity, 1e-6, filled);
  cv::dilate(filled, nearest, cv::Mat1b(3, 3, std::uint8_t{1}));
  cv::erode(filled, farthest, cv::Mat1b(3, 3, std::uint8_t{1}));
  for (int v = 0; v < disparity.rows; ++v) {
    for (int u = 0; u < disparity.cols; ++u) {
      const bool edge =
          static_cast<double>(nearest(v, u)) > (1 + kJump) * static_cast<double>(farthest(v, u));
      if (edge && ragged(v, u) > -0.4f) disparity(v, u) = 0;
    }
  }
}

}  // namespace

Camera structured_light_camera(cv::Size size) {
  const double focal = 570.0 * size.width / 640;
  return {size.width, size.height, focal, focal, (size.width - 1) / 2.0, (size.height - 1) / 2.0, {}};
}

cv::Mat1f correlated_noise(cv::Size size, double sigma_px, std::uint64_t seed, std::uint64_t stream) {
  const int margin = static_cast<int>(std::ceil(4 * sigma_px));
  cv::Mat1f white(size.height + 2 * margin, size.width + 2 * margin);
  const CounterRandom random(seed, stream);
  std::uint64_t index = 0;
  for (float& value : white) value = static_cast<float>(random.normal(index++));
  const cv::Mat1d kernel = cv::getGaussianKernel(2 * margin + 1, sigma_px, CV_64F);
  cv::Mat1f smooth;
  cv::sepFilter2D(white, smooth, CV_32F, kernel, kernel, {-1, -1}, 0, cv::BORDER_REFLECT);
  const double deviation =
      kernel.dot(kernel);  // of the blurred noise: the sum of squared weights a dimension
  cv::Mat1f cropped;
  smooth(cv::Rect({margin, margin}, size)).convertTo(cropped, CV_32F, 1 / deviation);
  return cropped;
}

DepthSensor::DepthSensor(const SimulateOptions& options, const Camera& camera, const RayTracer& tracer)
    : options_(options.depth),
      seed_(options.seed),
      unit_px_(camera.width / kReferenceWidth),
      view_(look(camera, tracer)),
      fixed_noise_(correlated_noise(camera.size(), options_.correlation_px * unit_px_, seed_, kFixed)) {}

DepthSensor::View DepthSensor::look(const Camera& camera, const RayTracer& tracer) const {
  View view{cv::Mat1f(camera.size(), 0.0f), camera.fx / unit_px_ * options_.baseline_m};
  const cv::Mat1f ragged = correlated_noise(camera.size(), 1.2 * unit_px_, seed_, kRagged);
  const double shift = options_.noise_mm > 0 ? kEdgeShiftPx * unit_px_ : 0;
  const cv::Mat1f shift_x = correlated_noise(camera.size(), 1.5 * unit_px_, seed_, kShiftX);
  const cv::Mat1f shift_y = correlated_noise(camera.size(), 1.5 * unit_px_, seed_, kShiftY);
  cv::parallel_for_({0, camera.height}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const auto ray = pixel_ray(camera, u + shift * static_cast<double>(shift_x(v, u)),
                                   v + shift * static_cast<double>(shift_y(v, u)));
        const auto hit = tracer.trace(Eigen::Vector3f::Zero(), ray);
        if (!hit || !reads(options_, tracer, *hit, ragged(v, u))) continue;
        view.disparity(v, u) =
            static_cast<float>(view.focal_times_baseline / static_cast<double>(hit->position.z()));
      }
    }
  });
  if (options_.holes) drop_edges(view.disparity, ragged);
  return view;
}

std::uint16_t DepthSensor::raw_depth(double disparity) const {
  const double step = options_.disparity_step_px;
  const double read = step > 0 ? step * std::round(disparity / step) : disparity;
  if (read <= 0) return 0;
  const double raw = std::round(view_.focal_times_baseline / read / options_.unit_m);
  return raw <= 65535 ? static_cast<std::uint16_t>(raw) : std::uint16_t{0};
}

cv::Mat1w DepthSensor::frame(int number) const {
  const auto index = static_cast<std::uint64_t>(number);
  const cv::Mat1f drift =
      correlated_noise(fixed_noise_.size(), options_.correlation_px * unit_px_, seed_, kDrift + index);
  const CounterRandom white(seed_, kWhite + index);
  // Millimetres at 1 m -> pixels of disparity: dd = f b / z^2 dz at z = 1.
  const double px_per_mm = 1e-3 * view_.focal_times_baseline;
  const double drift_share = options_.correlated_drift;
  const double fixed_share = std::sqrt(1 - drift_share * drift_share);
  cv::Mat1w raw(fixed_noise_.size(), std::uint16_t{0});
  for (int v = 0; v < raw.rows; ++v) {
    for (int u = 0; u < raw.cols; ++u) {
      if (view_.disparity(v, u) <= 0) continue;
      const auto pixel = static_cast<std::uint64_t>(v) * static_cast<std::uint64_t>(raw.cols) +
                         static_cast<std::uint64_t>(u);
      const double correlated = fixed_share * static_cast<double>(fixed_noise_(v, u)) +
                                drift_share * static_cast<double>(drift(v, u));
      const double error_mm = options_.noise_mm * correlated + options_.white_noise_mm * white.normal(pixel);
      raw(v, u) = raw_depth(static_cast<double>(view_.disparity(v, u)) - px_per_mm * error_mm);
    }
  }
  return raw;
}

std::vector<cv::Mat1w> sense_depth(const SimulateOptions& options, const Camera& camera,
                                   const RayTracer& tracer, int count) {
  const DepthSensor sensor(options, camera, tracer);
  std::vector<cv::Mat1w> frames(static_cast<std::size_t>(count));
  cv::parallel_for_({0, count}, [&](const cv::Range& range) {
    for (int k = range.start; k < range.end; ++k) frames[static_cast<std::size_t>(k)] = sensor.frame(k);
  });
  return frames;
}

}  // namespace rakelight
