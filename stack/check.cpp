// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/check.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kLeastObjectPixels = 9;      // one 3 x 3 neighbourhood: below it no normal exists
constexpr double kSaturatedImage = 0.99;   // of the object's pixels
constexpr int kBlack8 = 2, kBlack16 = 64;  // highest code of an image that shows nothing

std::string to_text(cv::Size size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

std::string subject(const LightStack& stack) { return stack.origin.empty() ? "the stack" : stack.origin; }

/// The mask on the grid of colour; empty without one.
cv::Mat1b color_mask(const LightStack& stack) {
  cv::Mat1b mask = stack.mask;
  if (!mask.empty() && mask.size() != stack.color_camera.size()) {
    cv::resize(stack.mask, mask, stack.color_camera.size(), 0, 0, cv::INTER_NEAREST);
  }
  return mask;
}

void check_image_size(const LightStack& stack, const Frame& frame, const cv::Mat& image, const Camera& camera,
                      const char* kind) {
  if (image.empty() || image.size() == camera.size()) return;
  throw InputError(subject(stack),
                   std::string(kind) + " of frame " + std::to_string(frame.index) + " is " +
                       to_text(image.size()) + " where its camera has " + to_text(camera.size()),
                   "use images of one size that fit the cameras");
}

void check_sizes(const LightStack& stack) {
  for (const Frame& frame : stack.frames) {
    check_image_size(stack, frame, frame.color, stack.color_camera, "colour");
    check_image_size(stack, frame, frame.depth, stack.depth_camera, "depth");
  }
  const cv::Size mask = stack.mask.size();
  if (!stack.mask.empty() && mask != stack.color_camera.size() && mask != stack.depth_camera.size()) {
    throw InputError(subject(stack), "the mask's size " + to_text(mask) + " is neither colour's nor depth's",
                     "make the mask on a colour or a depth image");
  }
}

void check_mask(const LightStack& stack) {
  if (stack.mask.empty()) return;
  const int count = cv::countNonZero(stack.mask);
  if (count == 0)
    throw InputError(subject(stack), "the mask is empty", "mark the object with 255 in mask.png");
  if (count < kLeastObjectPixels) {
    throw InputError(subject(stack), "the mask holds only " + std::to_string(count) + " pixels",
                     "mark the whole object with 255 in mask.png");
  }
}

/// 255 where any depth frame has a reading, with that reading.
cv::Mat1w any_depth(const LightStack& stack) {
  cv::Mat1w merged;
  for (const Frame& frame : stack.frames) {
    if (frame.depth.empty()) continue;
    merged = merged.empty() ? frame.depth.clone() : cv::Mat1w(cv::max(merged, frame.depth));
  }
  return merged;
}

void check_depth(const LightStack& stack) {
  const cv::Mat1w depth = any_depth(stack);
  if (depth.empty()) {
    throw InputError(subject(stack), "has no depth image", "record depth with the colour images");
  }
  if (cv::countNonZero(depth) == 0) {
    throw InputError(subject(stack), "every depth value is 0 (no reading)",
                     "check the sensor's range and record again");
  }
  if (masked_depth_count(stack) < kLeastObjectPixels) {
    throw InputError(subject(stack), "the depth has no readings where the mask marks the object",
                     "check that mask and depth belong together, and the sensor's range");
  }
}

void check_light(const LightStack& stack) {
  bool any = false, all_black = true, all_saturated = true;
  for (const Frame& each : stack.frames) {
    if (!has_color(each) || !each.light) continue;
    const Frame frame = with_color(each);
    any = true;
    const bool black = is_black(stack, frame);
    const bool saturated = !black && saturated_share(stack, frame) > kSaturatedImage;
    if (!black && !saturated) return;
    all_black = all_black && black;
    all_saturated = all_saturated && saturated;
  }
  if (!any) throw InputError(subject(stack), "has no colour image under a lamp", "record one image a lamp");
  const std::string fault = all_black       ? "every image is black on the object"
                            : all_saturated ? "every image is saturated on the object"
                                            : "every image is black or saturated on the object";
  throw InputError(subject(stack), fault, "check the lamps and the exposure and record again");
}

}  // namespace

double saturated_share(const LightStack& stack, const Frame& frame) {
  cv::Mat1b clipped = saturated(frame);
  if (clipped.empty()) return 0;
  const cv::Mat1b mask = color_mask(stack);
  const int all = mask.empty() ? clipped.rows * clipped.cols : cv::countNonZero(mask);
  if (!mask.empty()) cv::bitwise_and(clipped, mask, clipped);
  return all == 0 ? 0 : double(cv::countNonZero(clipped)) / all;
}

bool is_black(const LightStack& stack, const Frame& frame) {
  if (frame.color.empty()) return false;
  const cv::Mat1b mask = color_mask(stack);
  const int threshold = frame.color.depth() == CV_16U ? kBlack16 : kBlack8;
  for (int channel = 0; channel < 3; ++channel) {
    cv::Mat values;
    cv::extractChannel(frame.color, values, channel);
    double highest = 0;
    cv::minMaxLoc(values, nullptr, &highest, nullptr, nullptr, mask);
    if (highest > threshold) return false;
  }
  return true;
}

int masked_depth_count(const LightStack& stack) {
  const cv::Mat1w depth = any_depth(stack);
  if (stack.mask.empty()) return depth.empty() ? 0 : cv::countNonZero(depth);
  const bool on_depth_grid = stack.mask.size() != stack.color_camera.size();
  const Camera& from = stack.depth_camera;
  const Camera& to = stack.color_camera;
  int count = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (depth(y, x) == 0) continue;
      int u = x, v = y;
      if (!on_depth_grid) {  // lens distortion moves a pixel too little to matter here
        const double z = depth(y, x) * stack.depth_unit_m;
        const Eigen::Vector4d point((x - from.cx) / from.fx * z, (y - from.cy) / from.fy * z, z, 1);
        const Eigen::Vector4d seen = stack.T_color_depth * point;
        const double column = to.fx * seen.x() / seen.z() + to.cx, row = to.fy * seen.y() / seen.z() + to.cy;
        if (!(seen.z() > 0 && column > -0.5 && row > -0.5 && column < to.width - 0.5 &&
              row < to.height - 0.5)) {
          continue;
        }
        u = static_cast<int>(std::lround(column));
        v = static_cast<int>(std::lround(row));
      }
      if (u < stack.mask.cols && v < stack.mask.rows && stack.mask(v, u) != 0) ++count;
    }
  }
  return count;
}

void check_stack(const LightStack& stack) {
  check_sizes(stack);
  check_mask(stack);
  check_depth(stack);
  check_light(stack);
}

}  // namespace rakelight
