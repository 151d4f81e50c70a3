// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A stack's images, small: what a report shows of them. They are made when an image is decoded anyway.
#pragma once

#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

constexpr int kThumbnailSide = 200;           ///< pixels, longest side
constexpr std::size_t kMostThumbnails = 120;  ///< of the first frames with colour

struct FrameThumbnail {
  std::size_t frame = 0;  ///< position in LightStack::frames
  cv::Mat color;          ///< as Frame::color, cropped to the object and averaged down
  double clipped = 0;     ///< share of the object that is clipped
};

/// The part of a surface's grid that pictures show: the object and a small margin.
/// @param surface 255 = object; everything where there is none
cv::Rect object_box(const cv::Mat1b& surface);

/// @param frame with its colour in memory  @param surface 255 where the surface is, on a grid of the same view
FrameThumbnail frame_thumbnail(std::size_t position, const Frame& frame, const cv::Mat1b& surface);

/// Averaged down so that the longest side has at most so many pixels; never a view of `picture`.
cv::Mat shrunk(const cv::Mat& picture, int side);

/// Positions of the frames that get a picture.
std::vector<std::size_t> thumbnail_frames(const LightStack& stack);

/// Pictures of all of those.
std::vector<FrameThumbnail> frame_thumbnails(const LightStack& stack, const cv::Mat1b& surface);

}  // namespace rakelight
