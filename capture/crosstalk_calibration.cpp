// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "capture/color_calibration.h"
#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr int kTiles = 4;              // regions a side, for the spread
constexpr float kFewestLight = 0.02f;  // of full scale, in the LED's own channel
constexpr float kBright = 0.25f;  // share of the brightest: shadows and the card's surroundings are left out

/// Light of one LED colour, summed over pixels: of each region and of the whole.
struct Sums {
  std::array<Eigen::Vector3d, kTiles * kTiles> tile;
  int pixels = 0;
  Sums() { tile.fill(Eigen::Vector3d::Zero()); }
};

std::optional<int> channel_of(LampColor color) {
  if (color == LampColor::red) return 0;
  if (color == LampColor::green) return 1;
  if (color == LampColor::blue) return 2;
  return {};
}

/// The channel of the frame's lamp; nothing for dark, white and mixed light.
std::optional<int> channel_of(const LightStack& stack, const Frame& frame) {
  if (!frame.light || frame.color.empty()) return {};
  const auto light = std::find_if(stack.lights.begin(), stack.lights.end(),
                                  [&](const Light& candidate) { return candidate.id == *frame.light; });
  return light == stack.lights.end() ? std::nullopt : channel_of(light->color);
}

cv::Mat3f dark_mean(const LightStack& stack) {
  cv::Mat3f sum;
  int count = 0;
  for (const Frame& frame : stack.frames) {
    if (frame.light || frame.color.empty()) continue;
    const cv::Mat3f dark = linear_color(stack, frame);
    sum = sum.empty() ? dark : cv::Mat3f(sum + dark);
    ++count;
  }
  return count == 0 ? sum : cv::Mat3f(sum / count);
}

/// What all but the brightest hundredth stay below.
float nearly_brightest(const cv::Mat3f& light, int channel) {
  std::vector<float> values;
  for (const cv::Vec3f& pixel : light) values.push_back(pixel[channel]);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void add_light(const cv::Mat3f& light, const cv::Mat1b& excluded, int channel, Sums& sums) {
  const float least = std::max(kFewestLight, kBright * nearly_brightest(light, channel));
  for (int v = 0; v < light.rows; ++v) {
    for (int u = 0; u < light.cols; ++u) {
      const cv::Vec3f& value = light(v, u);
      if (excluded(v, u) != 0 || value[channel] < least) continue;
      const int tile = v * kTiles / light.rows * kTiles + u * kTiles / light.cols;
      sums.tile[static_cast<std::size_t>(tile)] +=
          Eigen::Vector3f(value[0], value[1], value[2]).cast<double>();
      ++sums.pixels;
    }
  }
}

void check_column(const LightStack& stack, const std::string& color, const Eigen::Vector3d& column,
                  int channel) {
  if (column.maxCoeff() <= column[channel] * (1 + 1e-9)) return;
  throw InputError(stack.origin, "the " + color + " lamp lights another channel more than its own",
                   "check that lamps are wired as the rig says and that the card is white");
}

}  // namespace

CrosstalkFit measure_crosstalk(const LightStack& recorded) {
  LightStack stack = recorded;
  stack.color_crosstalk.setIdentity();
  const cv::Mat3f dark = dark_mean(stack);
  std::array<Sums, 3> sums;
  for (const Frame& frame : stack.frames) {
    const auto channel = channel_of(stack, frame);
    if (!channel) continue;
    cv::Mat3f light = linear_color(stack, frame);
    if (!dark.empty()) light -= dark;
    cv::Mat1b excluded = saturated(frame);
    if (stack.mask.size() == excluded.size()) excluded.setTo(255, stack.mask == 0);
    add_light(light, excluded, *channel, sums[static_cast<std::size_t>(*channel)]);
  }
  CrosstalkFit fit;
  for (int c = 0; c < 3; ++c) {
    const Sums& light = sums[static_cast<std::size_t>(c)];
    const std::string color =
        to_string(std::array{LampColor::red, LampColor::green, LampColor::blue}[static_cast<std::size_t>(c)]);
    if (light.pixels < 1000) {
      throw InputError(
          stack.origin, "shows too little unclipped light of a " + color + " lamp alone",
          "record a white card under each of the red, green and blue lamps, exposed so that none clips");
    }
    Eigen::Vector3d whole = Eigen::Vector3d::Zero(), variance = Eigen::Vector3d::Zero();
    for (const auto& tile : light.tile) whole += tile;
    fit.crosstalk.col(c) = whole / whole[c];
    int tiles = 0;
    for (const auto& tile : light.tile) {
      if (tile[c] <= 0) continue;
      variance += (tile / tile[c] - fit.crosstalk.col(c)).cwiseAbs2();
      ++tiles;
    }
    fit.deviation.col(c) = (variance / std::max(1, tiles - 1)).cwiseSqrt();
    fit.pixels += light.pixels;
    check_column(stack, color, fit.crosstalk.col(c), c);
  }
  return fit;
}

}  // namespace rakelight
