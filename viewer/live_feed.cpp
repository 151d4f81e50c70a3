// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <utility>

#include "viewer/color_map.h"
#include "viewer/live_view.h"

namespace rakelight {

void LiveFeed::show_color(const cv::Mat3b& color) {
  const cv::Mat3b copy = color.clone();
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.color = copy;
}

void LiveFeed::show_depth(const cv::Mat1w& depth, double depth_unit_m) {
  const cv::Mat1w copy = depth.clone();
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.depth = copy;
  news_.depth_unit_m = depth_unit_m;
}

void LiveFeed::show_surface(const Camera& camera, const cv::Mat1f& depth) {
  const cv::Mat1f copy = depth.clone();
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.camera = camera;
  news_.surface = copy;
}

void LiveFeed::show_scene(Scene scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.scene = std::move(scene);
}

void LiveFeed::say(const std::string& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.status = status;
}

bool LiveFeed::is_watched() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return watched_;
}

LiveFeed::News LiveFeed::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(news_, {});
}

void LiveFeed::stop_watching() {
  const std::lock_guard<std::mutex> lock(mutex_);
  watched_ = false;
}

cv::Mat3b depth_colors(const cv::Mat1w& depth, double depth_unit_m) {
  std::vector<float> readings;
  for (const ushort raw : depth) {
    if (raw > 0) readings.push_back(static_cast<float>(raw * depth_unit_m));
  }
  const ColorRange range = sequential_range(readings, "depth", "m");
  cv::Mat3b colors(depth.size(), cv::Vec3b::all(0));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (depth(y, x) > 0) colors(y, x) = color_of(range, depth(y, x) * depth_unit_m);
    }
  }
  return colors;
}

}  // namespace rakelight
