// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines and words on white paper, antialiased: what figures are drawn with. Lengths in pixels.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace rakelight {

enum class Align { left, middle, right };

class Canvas {
 public:
  explicit Canvas(const cv::Size& size);

  /// @param at of the text's baseline
  void text(const std::string& words, const cv::Point2d& at, double size, Align align = Align::left);
  void line(const std::vector<cv::Point2d>& points, const cv::Vec3d& color, double width);
  void area(const std::vector<cv::Point2d>& points, const cv::Vec3d& color, double opacity);
  /// Stretches a picture over a box; enlarged pixels stay square.
  void picture(const cv::Mat3b& rgb, const cv::Rect2d& box);
  double width_of(const std::string& words, double size);

  /// What was drawn, R G B.
  cv::Mat3b pixels() const;

 private:
  struct Cairo;
  std::shared_ptr<Cairo> cairo_;
};

}  // namespace rakelight
