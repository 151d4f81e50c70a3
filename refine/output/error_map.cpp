// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/error_map.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace rakelight {
namespace {

const cv::Vec3f kMinus(33, 102, 172), kZero(247, 247, 247), kPlus(178, 24, 43);

/// Millimetres, NaN where either is missing.
cv::Mat1f errors_mm(const cv::Mat1f& depth, const cv::Mat1f& truth) {
  cv::Mat1f true_depth = truth;
  if (truth.size() != depth.size()) cv::resize(truth, true_depth, depth.size(), 0, 0, cv::INTER_NEAREST);
  return cv::Mat(1000 * (depth - true_depth));
}

void write(cv::Mat3b& picture, const std::string& text, int x) {
  cv::putText(picture, text, {x, picture.rows - 3}, cv::FONT_HERSHEY_SIMPLEX, 0.38, cv::Scalar::all(235), 1,
              cv::LINE_AA);
}

}  // namespace

cv::Vec3b signed_color(float share) {
  const float s = std::clamp(share, -1.0f, 1.0f);
  const cv::Vec3f color = kZero + std::abs(s) * ((s < 0 ? kMinus : kPlus) - kZero);
  return cv::Vec3b(color);
}

double round_range(const cv::Mat1f& values, double share) {
  std::vector<float> sizes;
  for (const float value : values) {
    if (std::isfinite(value)) sizes.push_back(std::abs(value));
  }
  if (sizes.empty()) return 1;
  const auto most =
      sizes.begin() + static_cast<std::ptrdiff_t>(static_cast<double>(sizes.size() - 1) * share);
  std::nth_element(sizes.begin(), most, sizes.end());
  for (double decade = 1e-3;; decade *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (static_cast<double>(*most) <= step * decade || decade > 1e6) return step * decade;
    }
  }
}

cv::Mat3b error_colors(const cv::Mat1f& errors, double range) {
  cv::Mat3b picture(errors.size(), cv::Vec3b::all(0));
  for (int y = 0; y < errors.rows; ++y) {
    for (int x = 0; x < errors.cols; ++x) {
      if (std::isfinite(errors(y, x))) picture(y, x) = signed_color(errors(y, x) / static_cast<float>(range));
    }
  }
  return picture;
}

double error_range_mm(const cv::Mat1f& depth, const cv::Mat1f& truth) {
  return round_range(errors_mm(depth, truth), 0.9);
}

cv::Mat3b error_map(const cv::Mat1f& depth, const cv::Mat1f& truth, double range_mm) {
  return error_colors(errors_mm(depth, truth), range_mm);
}

cv::Mat3b error_scale(int width, double range_mm) {
  constexpr int kHeight = 26, kBar = 10;
  cv::Mat3b picture(kHeight, width, cv::Vec3b::all(0));
  for (int x = 0; x < width; ++x) {
    const float share = 2 * static_cast<float>(x) / static_cast<float>(std::max(1, width - 1)) - 1;
    picture(cv::Rect(x, 0, 1, kBar)).setTo(signed_color(share));
  }
  char text[32];
  std::snprintf(text, sizeof text, "%g mm", range_mm);
  write(picture, std::string("-") + text, 2);
  write(picture, std::string("+") + text, width - 8 * static_cast<int>(std::string(text).size() + 1));
  return picture;
}

}  // namespace rakelight
