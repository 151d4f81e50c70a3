// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From radiance to encoded pixels: exposure, crosstalk, noise, clipping, colour response, quantisation.
#pragma once

#include <opencv2/core.hpp>

#include "simulate/counter_random.h"
#include "simulate/options.h"

namespace rakelight {

/// Column k: what a unit of light of LED colour k leaves in the channels R, G, B (LightStack::color_crosstalk).
Eigen::Matrix3d crosstalk_matrix(double share);

class ImageSensor {
 public:
  ImageSensor(const SimulateOptions& options, double exposure);

  /// A black image of the sensor's depth.
  cv::Mat blank(cv::Size size) const;

  /// Writes one pixel of image `index`. Noise depends on seed, image and pixel only.
  void expose(const Eigen::Vector3f& radiance, int index, cv::Point pixel, cv::Mat& image) const;

 private:
  double encoded(double linear) const;

  const ImageOptions& options_;
  std::uint64_t seed_;
  double exposure_;
  Eigen::Matrix3d crosstalk_;
};

}  // namespace rakelight
