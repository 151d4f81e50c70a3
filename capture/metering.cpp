// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/metering.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr double kRank = 0.99;
constexpr double kLeastChange = 0.03;  // of exposure: less is no change

/// What to multiply by where clipping hides how bright it is.
double darkening(double saturated) {
  if (saturated > 0.2) return 0.3;
  return saturated > 0.05 ? 0.55 : 0.8;
}

double level_of(const CoarseScene& scene, const cv::Mat1b& object, const cv::Mat& color,
                const ColorResponse& response) {
  const cv::Mat3f cells = at_cells(scene, color, response);
  std::vector<float> values;
  for (int y = 0; y < cells.rows; ++y) {
    for (int x = 0; x < cells.cols; ++x) {
      const cv::Vec3f c = cells(y, x);
      if (object(y, x) != 0) values.push_back(std::max({c[0], c[1], c[2]}));
    }
  }
  if (values.empty()) return 0;
  const auto rank = values.begin() + std::ptrdiff_t(kRank * double(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  return double(*rank);
}

}  // namespace

Brightness measure_brightness(const CoarseScene& scene, const cv::Mat1b& object,
                              const std::vector<cv::Mat>& lit, const ColorResponse& response) {
  Brightness seen;
  for (const cv::Mat& color : lit) {
    seen.saturated = std::max(seen.saturated, cv::mean(saturated_cells(scene, color), object)[0]);
    seen.level = std::max(seen.level, level_of(scene, object, color, response));
  }
  return seen;
}

std::optional<ExposureSetting> better_exposure(const Brightness& seen, const ExposureSetting& now,
                                               const ExposureSetting& start, const MeteringLimits& limits) {
  double factor = 1;
  if (seen.saturated > limits.max_saturated) {
    factor = darkening(seen.saturated);
  } else if (seen.level < limits.dimmest) {
    factor = std::min(limits.target / std::max(seen.level, 1e-3), 4.0);
  }
  const double wanted = now.time_us * now.gain * factor;
  const double time_us = std::clamp(now.time_us * factor, limits.min_time_us, limits.max_time_us);
  const double gain =
      std::clamp(wanted / time_us, start.gain / limits.max_gain_factor, start.gain * limits.max_gain_factor);
  if (std::abs(time_us * gain / (now.time_us * now.gain) - 1) < kLeastChange) return std::nullopt;
  return ExposureSetting{time_us, gain};
}

}  // namespace rakelight
