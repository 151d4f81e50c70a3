// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A colour frame from pre-rendered lamps: a weighted sum a row, exposure, noise, clipping, encoding. Fast enough for a
// stream on one core.
#pragma once

#include <cstdint>
#include <vector>

#include "simulate/virtual_sensor/rolling_shutter.h"
#include "simulate/virtual_sensor/virtual_scene.h"

namespace rakelight {

/// What the camera is set to.
struct Exposure {
  double exposure_us = kReferenceExposureUs;
  double gain = kReferenceGain;
  cv::Vec3f white_balance{1, 1, 1};  ///< factors of R, G, B
};

class FrameRenderer {
 public:
  FrameRenderer(LampImages images, const ImageOptions& options, std::uint64_t seed);

  /// CV_8UC3 R, G, B. The same arguments give the same bytes. `light` has as many rows as the images.
  void render(const std::vector<LampRows>& light, const Exposure& exposure, int frame,
              cv::Mat3b& image) const;

  cv::Size size() const { return images_.ambient.size(); }
  const LampImages& images() const { return images_; }

 private:
  void mix_row(const std::vector<LampRows>& light, const Exposure& exposure, int row,
               std::vector<float>& sum) const;

  LampImages images_;
  ImageOptions options_;
  std::uint64_t seed_;
  std::vector<float> noise_;  ///< standard normal numbers, read from a place drawn anew a row and frame
  std::vector<std::uint8_t> encoded_;  ///< of linear k / (size - 1)
};

}  // namespace rakelight
