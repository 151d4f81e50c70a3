// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "refine/output/error_map.h"

namespace rakelight {
namespace {

const cv::Vec3b kNoValue(90, 90, 90);

const std::array<cv::Vec3b, 256>& viridis() {
  static const std::array<cv::Vec3b, 256> table = [] {
    cv::Mat1b ramp(1, 256);
    for (int i = 0; i < 256; ++i) ramp(0, i) = static_cast<uchar>(i);
    cv::Mat3b colors;
    cv::applyColorMap(ramp, colors, cv::COLORMAP_VIRIDIS);
    std::array<cv::Vec3b, 256> rgb;
    for (int i = 0; i < 256; ++i)
      rgb[static_cast<std::size_t>(i)] = {colors(0, i)[2], colors(0, i)[1], colors(0, i)[0]};
    return rgb;
  }();
  return table;
}

std::vector<float> finite_values(const std::vector<float>& values) {
  std::vector<float> finite;
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](float v) { return std::isfinite(v); });
  return finite;
}

/// @param values not empty; reordered
double percentile(std::vector<float>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return static_cast<double>(*at);
}

}  // namespace

cv::Vec3b color_of(const ColorRange& range, double value) {
  if (std::isnan(value)) return kNoValue;
  const double share = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
  if (range.scale == ColorScale::sequential)
    return viridis()[static_cast<std::size_t>(std::lround(share * 255))];
  return signed_color(static_cast<float>(2 * share - 1));
}

double round_up(double value) {
  if (!(value > 0) || !std::isfinite(value)) return 1;
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * decade * (1 + 1e-9)) return step * decade;
  }
  return 10 * decade;
}

ColorRange signed_range(const std::vector<float>& values, const std::string& quantity,
                        const std::string& unit) {
  std::vector<float> sizes = finite_values(values);
  for (float& value : sizes) value = std::abs(value);
  const double most = sizes.empty() ? 1 : round_up(percentile(sizes, 0.95));
  return {ColorScale::signed_, -most, most, quantity, unit};
}

ColorRange sequential_range(const std::vector<float>& values, const std::string& quantity,
                            const std::string& unit) {
  std::vector<float> finite = finite_values(values);
  if (finite.empty()) return {ColorScale::sequential, 0, 1, quantity, unit};
  const double low = percentile(finite, 0.01), high = percentile(finite, 0.99);
  const double least = 1e-6 * std::max(1.0, std::abs(low));  // a constant map, too, needs a range
  return {ColorScale::sequential, low, std::max(high, low + least), quantity, unit};
}

std::vector<double> ticks(const ColorRange& range) {
  constexpr int kMost = 6;
  const bool is_signed = range.scale == ColorScale::signed_;  // whose ends are round themselves
  const double step = is_signed ? range.high / 2 : round_up((range.high - range.low) / kMost);
  std::vector<double> marks;
  const double first = std::ceil(range.low / step - 1e-9), last = std::floor(range.high / step + 1e-9);
  for (double k = first; k <= last; ++k) marks.push_back(k * step + 0.0);
  return marks;
}

}  // namespace rakelight
