// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A structured-light depth sensor: what it sees, where it is blind, how it errs.
#pragma once

#include <vector>

#include "simulate/options.h"
#include "simulate/ray_tracer.h"

namespace rakelight {

/// The field of view of the usual structured-light sensor: f = 570 at 640 x 480.
Camera structured_light_camera(cv::Size size);

class DepthSensor {
 public:
  /// Looks at the scene once; what it sees is noisy anew a frame.
  DepthSensor(const SimulateOptions& options, const Camera& camera, const RayTracer& tracer);

  /// Raw units, 0 = no reading. The same number gives the same frame. Thread-safe.
  cv::Mat1w frame(int number) const;

 private:
  /// What does not change between frames.
  struct View {
    cv::Mat1f disparity;              ///< 0 where there is no reading
    double focal_times_baseline = 0;  ///< disparity = this / z
  };
  View look(const Camera& camera, const RayTracer& tracer) const;
  std::uint16_t raw_depth(double disparity) const;

  DepthSensorOptions options_;
  std::uint64_t seed_;
  double unit_px_;  ///< pixels of this grid a pixel of the one that options refer to
  View view_;
  cv::Mat1f fixed_noise_;
};

/// The first `count` frames of the scene seen by `camera`.
std::vector<cv::Mat1w> sense_depth(const SimulateOptions& options, const Camera& camera,
                                   const RayTracer& tracer, int count);

/// Unit-variance Gaussian noise with correlation radius `sigma_px` (autocorrelation exp(-r^2 / 4 sigma^2)).
cv::Mat1f correlated_noise(cv::Size size, double sigma_px, std::uint64_t seed, std::uint64_t stream);

}  // namespace rakelight
