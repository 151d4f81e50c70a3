// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/auto_mask.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <queue>

#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr float kLitShare = 0.06F;    // of the bright parts' light: less is background or shadow
constexpr double kBrightRank = 0.9;   // which part counts as bright
constexpr float kJump = 0.03F;        // of the depth between neighbours: another thing
constexpr double kHoleShare = 0.002;  // of the object: a hole up to this is one of the readings
constexpr double kMiddle = 0.5;       // the object is what fills most of this share of the picture, each way

/// Numbers the pieces of cells that are `lit` and joined without a depth jump, from 1 on.
cv::Mat1i label_pieces(const cv::Mat1f& depth, const cv::Mat1b& lit, int& count) {
  cv::Mat1i labels(depth.size(), 0);
  count = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (lit(y, x) == 0 || labels(y, x) != 0) continue;
      labels(y, x) = ++count;
      std::queue<cv::Point> open({cv::Point(x, y)});
      while (!open.empty()) {
        const cv::Point p = open.front();
        open.pop();
        for (const cv::Point step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
          const cv::Point q = p + step;
          if (!cv::Rect({}, depth.size()).contains(q) || lit(q) == 0 || labels(q) != 0) continue;
          if (std::abs(depth(q) - depth(p)) > kJump * depth(p)) continue;
          labels(q) = count;
          open.push(q);
        }
      }
    }
  }
  return labels;
}

/// The piece that fills most of the middle; 255 or 0.
cv::Mat1b middle_piece(const cv::Mat1f& depth, const cv::Mat1b& lit) {
  int count = 0;
  const cv::Mat1i labels = label_pieces(depth, lit, count);
  std::vector<int> area(static_cast<std::size_t>(count) + 1, 0);
  const cv::Size half(int(depth.cols * kMiddle), int(depth.rows * kMiddle));
  const cv::Rect middle((depth.cols - half.width) / 2, (depth.rows - half.height) / 2, half.width,
                        half.height);
  for (const int label : cv::Mat1i(labels(middle))) ++area[static_cast<std::size_t>(label)];
  area[0] = 0;
  const auto best = std::max_element(area.begin(), area.end());
  if (*best == 0) return cv::Mat1b(depth.size(), uchar{0});
  cv::Mat1b piece;
  cv::compare(labels, static_cast<int>(best - area.begin()), piece, cv::CMP_EQ);
  return piece;
}

/// 255 where there is depth and light.
cv::Mat1b lit_cells(const cv::Mat1f& depth, const cv::Mat1f& light) {
  std::vector<float> values;
  for (int i = 0; i < int(depth.total()); ++i) {
    if (depth(i) > 0) values.push_back(light(i));
  }
  if (values.empty()) return cv::Mat1b(depth.size(), uchar{0});
  const auto rank = values.begin() + std::ptrdiff_t(kBrightRank * double(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  cv::Mat1b lit;
  cv::bitwise_and(depth > 0, light > kLitShare * *rank, lit);
  return lit;
}

/// Nearest reading of all frames, metres; 0: none.
cv::Mat1f any_depth(const LightStack& stack) {
  cv::Mat1f depth(stack.depth_camera.size(), 0.0F);
  for (const Frame& frame : stack.frames) {
    if (frame.depth.empty()) continue;
    cv::Mat1f metres;
    frame.depth.convertTo(metres, CV_32F, stack.depth_unit_m);
    metres.copyTo(depth, (depth == 0) & (metres > 0));
  }
  return depth;
}

/// Greatest light of any lamp less the dark, sum of channels, on the colour grid.
cv::Mat1f lamp_light(const LightStack& stack) {
  cv::Mat3f dark;
  cv::Mat3f most(stack.color_camera.size(), cv::Vec3f(0, 0, 0));
  for (const Frame& frame : stack.frames) {
    if (frame.color.empty()) continue;
    if (frame.light) {
      most = cv::max(most, linear_color(stack, frame));
    } else if (dark.empty()) {
      dark = linear_color(stack, frame);
    }
  }
  if (!dark.empty()) most -= dark;
  cv::Mat1f light;
  cv::transform(most, light, cv::Matx13f(1, 1, 1));
  return light;
}

/// Fills what the depth sensor did not read within the object; a larger hole may be one of the object, as in a handle.
void fill_small_holes(cv::Mat1b& mask) {
  const double largest = kHoleShare * cv::countNonZero(mask);
  cv::Mat1i labels, stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask == 0, labels, stats, centroids, 4);
  for (int label = 1; label < count; ++label) {
    const cv::Rect box(stats(label, cv::CC_STAT_LEFT), stats(label, cv::CC_STAT_TOP),
                       stats(label, cv::CC_STAT_WIDTH), stats(label, cv::CC_STAT_HEIGHT));
    const bool enclosed = box.x > 0 && box.y > 0 && box.br().x < mask.cols && box.br().y < mask.rows;
    if (enclosed && stats(label, cv::CC_STAT_AREA) <= largest) mask.setTo(255, labels == label);
  }
}

cv::Mat1f depth_of_points(const CoarseScene& scene) {
  cv::Mat1f depth;
  cv::extractChannel(scene.points, depth, 2);
  cv::patchNaNs(depth, 0);
  return depth;
}

}  // namespace

cv::Mat1b object_cells(const CoarseScene& scene, const cv::Mat1f& light) {
  const cv::Mat1f depth = depth_of_points(scene);
  return middle_piece(depth, lit_cells(depth, light));
}

cv::Mat1b auto_mask(const LightStack& stack) {
  const cv::Mat1f depth = any_depth(stack), on_color = lamp_light(stack);
  cv::Mat1f light(depth.size(), 0.0F);
  const Camera& from = stack.depth_camera;
  const Camera& to = stack.color_camera;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double z = static_cast<double>(depth(y, x));
      if (z <= 0) continue;
      const Eigen::Vector4d p((x - from.cx) / from.fx * z, (y - from.cy) / from.fy * z, z, 1);
      const Eigen::Vector4d q = stack.T_color_depth * p;
      const cv::Point pixel(cvRound(to.fx * q.x() / q.z() + to.cx), cvRound(to.fy * q.y() / q.z() + to.cy));
      if (q.z() > 0 && cv::Rect({}, to.size()).contains(pixel)) light(y, x) = on_color(pixel);
    }
  }
  cv::Mat1b mask = middle_piece(depth, lit_cells(depth, light));
  if (cv::countNonZero(mask) == 0) return {};
  const cv::Mat disk = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, disk);  // holes of the depth and of deep shadow
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, disk);   // stray pixels at edges
  fill_small_holes(mask);
  return mask;
}

}  // namespace rakelight
