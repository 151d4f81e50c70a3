// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the images say at the pixels of the grid.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "refine/cache_lines.h"
#include "refine/kernels/tile.h"
#include "refine/pixel_grid.h"
#include "stack/stack.h"

namespace rakelight {

/// Samples of one channel of one image: radiance = least + step * code.
class ChannelSamples {
 public:
  /// The code of a sample that is clipped or missing. It reads as just above the brightest that can be used.
  static constexpr std::uint16_t kUnusable = kernels::TileImage::kUnusable;

  ChannelSamples(const std::uint16_t* codes, float step, float least)
      : codes_(codes), step_(step), least_(least) {}

  float operator[](int pixel) const { return least_ + step_ * static_cast<float>(codes_[pixel]); }
  bool usable(int pixel) const { return codes_[pixel] != kUnusable; }

  /// Of whole tiles (kernels::kTilePixels): behind the last pixel, none can be used.
  const std::uint16_t* codes() const { return codes_; }
  float step() const { return step_; }
  float least() const { return least_; }

 private:
  const std::uint16_t* codes_;
  float step_, least_;
};

/// Samples as numbers, [image][channel][pixel]: where there are few of them.
struct PlainSamples {
  std::vector<float> radiance;
  std::vector<unsigned char> usable;  ///< 1, or 0 where the channel is clipped or has no sample
};

/// Linear radiance of every lit image at the grid's pixels, planar: one run of pixels a channel, three channels an image.
/// Samples are kept in 16 bits, each channel's range spread over them: finer than any sensor's noise, and what limits the
/// refinement is how fast they can be read.
class Observations {
 public:
  int pixels = 0;
  int images = 0;
  std::vector<std::string> light_ids;                          ///< [image]
  std::vector<int> frame_index;                                ///< [image]
  std::vector<bool> colored_lamps;                             ///< [image] red, green and blue lamps at once
  std::vector<std::optional<Eigen::Vector3d>> lamp_positions;  ///< [image] where the stack gives one, metres

  Observations() = default;

  /// Images without a usable sample yet.
  Observations(int pixel_count, int image_count);

  /// The samples of one channel. @param radiance [pixel]  @param usable [pixel] 1 or 0
  void set_channel(int image, int channel, const float* radiance, const unsigned char* usable);

  ChannelSamples channel(int image, int c) const {
    const size_t at = 3 * static_cast<size_t>(image) + static_cast<size_t>(c);
    return {codes_.data() + at * stride_, encoding_[at].step, encoding_[at].least};
  }

  /// Whether every channel of the image's samples [piece, piece + 1) * kernels::kPiecePixels can be used. False of a piece that the
  /// pixels end in.
  bool whole(int image, int piece) const {
    const auto at = static_cast<size_t>(image) * 3 * pieces_ + static_cast<size_t>(piece);
    return whole_[at] && whole_[at + pieces_] && whole_[at + 2 * pieces_];
  }

  bool usable(int image, int c, int pixel) const { return channel(image, c).usable(pixel); }

  Eigen::Vector3f radiance_at(int image, int pixel) const {
    return {channel(image, 0)[pixel], channel(image, 1)[pixel], channel(image, 2)[pixel]};
  }

  /// 1 or 0 a channel: whether this sample can be used.
  Eigen::Vector3f usable_channels(int image, int pixel) const {
    const auto number = [&](int c) { return usable(image, c, pixel) ? 1.0f : 0.0f; };
    return {number(0), number(1), number(2)};
  }

  PlainSamples plain() const;
  void set(const PlainSamples& samples);

  /// One image alone.
  Observations only(int image) const;

  /// Copies a channel of another set of images of the same pixels.
  void copy_channel(const Observations& from, int from_image, int image, int channel);

 private:
  struct Encoding {
    float step = 0, least = 0;
  };

  void note_whole_pieces(size_t at);

  size_t pieces_ = 0, stride_ = 0;        ///< a channel
  CacheLineVector<std::uint16_t> codes_;  ///< [image][channel][pixel], filled up to whole tiles
  std::vector<Encoding> encoding_;        ///< [image][channel]
  std::vector<unsigned char> whole_;      ///< [image][channel][piece] 1 where every sample can be used
};

/// Called with the position in LightStack::frames of a frame that has colour, and the frame, decoded; from several threads.
using FrameVisitor = std::function<void(std::size_t position, const Frame& frame)>;

/// Samples every lit frame of the stack on the grid, whose camera is the colour camera, undistorted and averaged down.
/// Dark frames are subtracted. Images are decoded in parallel; each thread holds one at a time.
/// @param visit is shown every frame with colour on the way, each once: reading an image from the disk again takes time
Observations observe(const LightStack& stack, const PixelGrid& grid, const FrameVisitor& visit = {});

}  // namespace rakelight
