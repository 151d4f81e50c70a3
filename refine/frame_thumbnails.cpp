// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/frame_thumbnails.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "stack/color_response.h"
#include "stack/parallel.h"

namespace rakelight {
namespace {

/// The box on an image of another size than its grid.
cv::Rect on_image(const cv::Rect& box, const cv::Size& grid, const cv::Size& image) {
  const double sx = static_cast<double>(image.width) / grid.width,
               sy = static_cast<double>(image.height) / grid.height;
  const cv::Rect scaled(cvFloor(box.x * sx), cvFloor(box.y * sy), cvCeil(box.width * sx),
                        cvCeil(box.height * sy));
  return scaled & cv::Rect({0, 0}, image);
}

}  // namespace

cv::Rect object_box(const cv::Mat1b& surface) {
  const cv::Rect box = cv::boundingRect(surface), all({0, 0}, surface.size());
  const int margin = 4;
  return box.empty()
             ? all
             : cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
                   all;
}

FrameThumbnail frame_thumbnail(std::size_t position, const Frame& frame, const cv::Mat1b& surface) {
  const cv::Rect box = object_box(surface);
  Frame cropped = frame;
  cropped.color = frame.color(on_image(box, surface.size(), frame.color.size()));
  cv::Mat1b object;
  cv::resize(surface(box), object, cropped.color.size(), 0, 0, cv::INTER_NEAREST);
  const int clipped = cv::countNonZero(saturated(cropped) & object);
  return {position, shrunk(cropped.color, kThumbnailSide),
          static_cast<double>(clipped) / std::max(1, cv::countNonZero(object))};
}

cv::Mat shrunk(const cv::Mat& picture, int side) {
  const double factor = static_cast<double>(side) / std::max(picture.cols, picture.rows);
  if (factor >= 1) return picture.clone();
  const cv::Size size(std::max(1, cvRound(picture.cols * factor)),
                      std::max(1, cvRound(picture.rows * factor)));
  cv::Mat small;
  cv::resize(picture.clone(), small, size, 0, 0, cv::INTER_AREA);
  return small;
}

std::vector<std::size_t> thumbnail_frames(const LightStack& stack) {
  std::vector<std::size_t> positions;
  for (std::size_t at = 0; at < stack.frames.size() && positions.size() < kMostThumbnails; ++at)
    if (has_color(stack.frames[at])) positions.push_back(at);
  return positions;
}

std::vector<FrameThumbnail> frame_thumbnails(const LightStack& stack, const cv::Mat1b& surface) {
  const std::vector<std::size_t> positions = thumbnail_frames(stack);
  std::vector<FrameThumbnail> thumbnails(positions.size());
  in_parallel(static_cast<int>(positions.size()), [&](int k) {
    const std::size_t at = positions[static_cast<std::size_t>(k)];
    thumbnails[static_cast<std::size_t>(k)] = frame_thumbnail(at, with_color(stack.frames[at]), surface);
  });
  return thumbnails;
}

}  // namespace rakelight
