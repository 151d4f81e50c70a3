// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/observations.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

cv::Matx33d intrinsic_matrix(const Camera& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

/// Brings full-size colour images to the grid: removes lens distortion, then averages blocks.
class ColorSampler {
 public:
  ColorSampler(const Camera& color_camera, const Camera& grid_camera) : size_(grid_camera.size()) {
    if (color_camera.distortion.empty()) return;
    const cv::Matx33d K = intrinsic_matrix(color_camera);
    cv::initUndistortRectifyMap(K, color_camera.distortion, cv::noArray(), K, color_camera.size(), CV_32FC1, map_x_,
                                map_y_);
  }

  template <class Image>
  Image operator()(const Image& full) const {
    Image straight = full;
    if (!map_x_.empty()) cv::remap(full, straight, map_x_, map_y_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    if (straight.size() == size_) return straight;
    Image small;
    cv::resize(straight, small, size_, 0, 0, cv::INTER_AREA);
    return small;
  }

 private:
  cv::Size size_;
  cv::Mat map_x_, map_y_;
};

/// Mean of the dark frames, empty if there are none.
cv::Mat3f ambient_image(const LightStack& stack) {
  cv::Mat3f sum;
  int count = 0;
  for (const Frame& frame : stack.frames) {
    if (frame.light || frame.color.empty()) continue;
    const cv::Mat3f dark = linear_color(stack, frame);
    if (sum.empty()) sum = dark; else sum += dark;
    ++count;
  }
  return sum.empty() ? sum : cv::Mat3f(sum / count);
}

const Light& light_of(const LightStack& stack, const Frame& frame) {
  for (const Light& light : stack.lights)
    if (light.id == *frame.light) return light;
  throw InputError(stack.origin, "frame " + std::to_string(frame.index) + " names the unknown light " + *frame.light,
                   "list it under lights");
}

void append_image(const PixelGrid& grid, const cv::Mat3f& color, const cv::Mat3b& clipped, Observations& out) {
  const size_t start = out.radiance.size();
  const size_t count = static_cast<size_t>(out.pixels);
  out.radiance.resize(start + 3 * count);
  out.usable.resize(start + 3 * count);
  for (size_t p = 0; p < count; ++p) {
    const cv::Vec3f& value = color(grid.pixels[p]);
    for (int c = 0; c < 3; ++c) {
      const size_t at = start + static_cast<size_t>(c) * count + p;
      out.radiance[at] = value[c];
      out.usable[at] = clipped(grid.pixels[p])[c] == 0;
    }
  }
}

}  // namespace

Observations observe(const LightStack& stack, const PixelGrid& grid) {
  Observations out;
  out.pixels = grid.size();
  const ColorSampler sample(stack.color_camera, grid.camera);
  const cv::Mat3f ambient = ambient_image(stack);
  for (const Frame& frame : stack.frames) {
    if (!frame.light || frame.color.empty()) continue;
    cv::Mat3f color = linear_color(stack, frame);
    if (!ambient.empty()) color -= ambient;
    cv::Mat3b clipped = saturated_channels(frame);
    if (!stack.color_crosstalk.isIdentity()) cv::merge(std::vector<cv::Mat>(3, saturated(frame)), clipped);
    append_image(grid, sample(color), sample(clipped), out);
    const Light& light = light_of(stack, frame);
    out.light_ids.push_back(light.id);
    out.colored_lamps.push_back(light.color == LampColor::rgb);
    out.lamp_positions.push_back(light.position_m);
    out.frame_index.push_back(frame.index);
    ++out.images;
  }
  return out;
}

}  // namespace rakelight
