// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/image_sensor.h"

#include <algorithm>
#include <cmath>

#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr std::uint64_t kImageNoise = 300;  ///< random stream of the first image

}  // namespace

Eigen::Matrix3d crosstalk_matrix(double share) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  for (const auto& [row, column] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}}) matrix(row, column) = share;
  return matrix;
}

ImageSensor::ImageSensor(const SimulateOptions& options, double exposure)
    : options_(options.image),
      seed_(options.seed),
      exposure_(exposure),
      crosstalk_(crosstalk_matrix(options.image.crosstalk)) {}

cv::Mat ImageSensor::blank(cv::Size size) const {
  return cv::Mat::zeros(size, options_.bits == 8 ? CV_8UC3 : CV_16UC3);
}

double ImageSensor::encoded(double linear) const {
  const double clipped = std::clamp(linear, 0.0, 1.0);
  return options_.response.kind == ColorResponse::Kind::linear ? clipped : encode(options_.response, clipped);
}

void ImageSensor::expose(const Eigen::Vector3f& radiance, int index, cv::Point pixel, cv::Mat& image) const {
  const CounterRandom random(seed_, kImageNoise + static_cast<std::uint64_t>(index));
  const Eigen::Vector3d signal = crosstalk_ * (exposure_ * radiance.cast<double>());
  const auto first = 3 * (static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(image.cols) +
                          static_cast<std::uint64_t>(pixel.x));
  const bool noisy = options_.read_noise > 0 || options_.shot_noise > 0;
  for (int c = 0; c < 3; ++c) {
    double value = signal[c];
    if (noisy) {
      const double variance = options_.read_noise * options_.read_noise +
                              options_.shot_noise * options_.shot_noise * std::max(0.0, value);
      value += std::sqrt(variance) * random.normal(first + static_cast<std::uint64_t>(c));
    }
    value = encoded(value);
    if (options_.bits == 8) {
      image.at<cv::Vec3b>(pixel)[c] = static_cast<std::uint8_t>(std::lround(255 * value));
    } else {
      image.at<cv::Vec3w>(pixel)[c] = static_cast<std::uint16_t>(std::lround(65535 * value));
    }
  }
}

}  // namespace rakelight
