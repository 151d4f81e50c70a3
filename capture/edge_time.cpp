// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/edge_time.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr int kBands = 60;
constexpr int kColumnStep = 4, kRowsPerBand = 2;  // of an image hundreds of pixels wide: noise is no concern
constexpr float kVisibleShare = 0.3F;             // of the largest change: darker bands say little
constexpr double kNone = 0.05, kAll = 0.95;       // shares taken for not lit and fully lit

std::array<float, 256> decoded_codes(const ColorResponse& response) {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = static_cast<float>(decode(response, double(i) / 255));
  return table;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

RowProfile row_profile(const cv::Mat& color, const ColorResponse& response) {
  const std::array<float, 256> decoded = decoded_codes(response);
  const int bands = std::min(kBands, color.rows);
  RowProfile profile;
  for (int band = 0; band < bands; ++band) {
    const int first = band * color.rows / bands;
    double sum = 0;
    int count = 0;
    for (int y = first; y < std::min(first + kRowsPerBand, color.rows); ++y) {
      for (int x = 0; x < color.cols; x += kColumnStep, ++count) {
        const auto& pixel = color.at<cv::Vec3b>(y, x);
        sum += static_cast<double>(decoded[pixel[0]] + decoded[pixel[1]] + decoded[pixel[2]]);
      }
    }
    profile.push_back(static_cast<float>(sum / count));
  }
  return profile;
}

float largest_difference(const RowProfile& a, const RowProfile& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

std::optional<EdgeTime> edge_time(const std::vector<ProfiledFrame>& frames, const RowProfile& before,
                                  const RowProfile& after, const FrameTiming& timing) {
  const float visible = kVisibleShare * largest_difference(before, after);
  std::vector<double> seen;
  std::optional<double> last_unlit, first_lit;  // closing of an unlit band, opening of a lit one
  for (const ProfiledFrame& frame : frames) {
    for (std::size_t band = 0; band < frame.profile.size(); ++band) {
      const float change = after[band] - before[band];
      if (std::abs(change) < visible) continue;
      const double row = (static_cast<double>(band) + 0.5) / static_cast<double>(frame.profile.size());
      const double closes = static_cast<double>(frame.time_us) - (1 - row) * timing.readout_us;
      const double share = static_cast<double>((frame.profile[band] - before[band]) / change);
      if (share > kNone && share < kAll) seen.push_back(closes - share * timing.exposure_us);
      if (share <= kNone) last_unlit = std::max(last_unlit.value_or(closes), closes);
      const double opens = closes - timing.exposure_us;
      if (share >= kAll) first_lit = std::min(first_lit.value_or(opens), opens);
    }
  }
  if (!last_unlit || !first_lit) return std::nullopt;
  if (seen.empty()) return EdgeTime{*last_unlit, *first_lit};
  const double edge = median(std::move(seen));
  return EdgeTime{edge, edge};
}

}  // namespace rakelight
