// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the images say at the pixels of the grid.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "refine/pixel_grid.h"
#include "stack/stack.h"

namespace rakelight {

/// Linear radiance of every lit image at the grid's pixels, planar: one run of pixels a channel, three channels an image.
struct Observations {
  int pixels = 0;
  int images = 0;
  std::vector<float> radiance;        ///< [image][channel][pixel]
  std::vector<unsigned char> usable;  ///< as radiance: 1, or 0 where the channel is clipped or has no sample
  std::vector<std::string> light_ids; ///< [image]
  std::vector<int> frame_index;       ///< [image]
  std::vector<bool> colored_lamps;    ///< [image] red, green and blue lamps at once
  std::vector<std::optional<Eigen::Vector3d>> lamp_positions;  ///< [image] where the stack gives one, metres

  const float* channel(int image, int c) const {
    return radiance.data() + (static_cast<size_t>(image) * 3 + static_cast<size_t>(c)) * static_cast<size_t>(pixels);
  }
  const unsigned char* usable_in(int image, int c) const {
    return usable.data() + (static_cast<size_t>(image) * 3 + static_cast<size_t>(c)) * static_cast<size_t>(pixels);
  }

  Eigen::Vector3f radiance_at(int image, int pixel) const {
    return {channel(image, 0)[pixel], channel(image, 1)[pixel], channel(image, 2)[pixel]};
  }

  /// 1 or 0 a channel: whether this sample can be used.
  Eigen::Vector3f usable_channels(int image, int pixel) const {
    return {static_cast<float>(usable_in(image, 0)[pixel]), static_cast<float>(usable_in(image, 1)[pixel]),
            static_cast<float>(usable_in(image, 2)[pixel])};
  }
};

/// Samples every lit frame of the stack on the grid, whose camera is the colour camera, undistorted and averaged down.
/// Dark frames are subtracted. One image is held decoded at a time.
Observations observe(const LightStack& stack, const PixelGrid& grid);

}  // namespace rakelight
