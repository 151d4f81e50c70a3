// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/color_response.h"

#include <Eigen/LU>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stack/errors.h"

namespace rakelight {
namespace {

/// Radiance of every code value: one pow a code instead of one a pixel.
std::vector<float> decoding_table(const ColorResponse& response, int codes) {
  std::vector<float> table(static_cast<std::size_t>(codes));
  for (int code = 0; code < codes; ++code) {
    table[static_cast<std::size_t>(code)] = static_cast<float>(decode(response, double(code) / (codes - 1)));
  }
  return table;
}

template <typename Code>
cv::Mat3f decode_image(const cv::Mat& color, const std::vector<float>& table) {
  cv::Mat3f linear(color.size());
  for (int y = 0; y < color.rows; ++y) {
    const Code* from = color.ptr<Code>(y);
    float* to = linear.ptr<float>(y);
    for (int i = 0; i < 3 * color.cols; ++i) to[i] = table[from[i]];
  }
  return linear;
}

void undo_crosstalk(const Eigen::Matrix3d& crosstalk, cv::Mat3f& linear) {
  if (crosstalk.isIdentity(0.0)) return;
  const Eigen::Matrix3f inverse = crosstalk.inverse().cast<float>();
  for (cv::Vec3f& pixel : linear) {
    const Eigen::Vector3f lamps = inverse * Eigen::Vector3f(pixel[0], pixel[1], pixel[2]);
    pixel = cv::Vec3f(lamps[0], lamps[1], lamps[2]);
  }
}

}  // namespace

ColorResponse parse_color_response(const std::string& text) {
  if (text == "linear") return {};
  if (text == "srgb") return {ColorResponse::Kind::srgb, 1.0};
  double gamma = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, gamma);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(gamma) || gamma <= 0) {
    throw UsageError("colour response '" + text + "': not understood; use linear, srgb or a positive gamma");
  }
  return {ColorResponse::Kind::gamma, gamma};
}

std::string to_string(const ColorResponse& response) {
  if (response.kind == ColorResponse::Kind::linear) return "linear";
  if (response.kind == ColorResponse::Kind::srgb) return "srgb";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, response.gamma).ptr};
}

double decode(const ColorResponse& response, double value) {
  switch (response.kind) {
    case ColorResponse::Kind::linear:
      return value;
    case ColorResponse::Kind::srgb:  // IEC 61966-2-1
      return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    case ColorResponse::Kind::gamma:
      return std::pow(value, response.gamma);
  }
  return value;
}

double encode(const ColorResponse& response, double radiance) {
  switch (response.kind) {
    case ColorResponse::Kind::linear:
      return radiance;
    case ColorResponse::Kind::srgb:
      return radiance <= 0.0031308 ? radiance * 12.92 : 1.055 * std::pow(radiance, 1 / 2.4) - 0.055;
    case ColorResponse::Kind::gamma:
      return std::pow(radiance, 1 / response.gamma);
  }
  return radiance;
}

cv::Mat3f linear_color(const LightStack& stack, const Frame& frame) {
  if (frame.color.empty()) return {};
  const bool deep = frame.color.depth() == CV_16U;
  const std::vector<float> table = decoding_table(stack.color_response, deep ? 65536 : 256);
  cv::Mat3f linear =
      deep ? decode_image<std::uint16_t>(frame.color, table) : decode_image<std::uint8_t>(frame.color, table);
  undo_crosstalk(stack.color_crosstalk, linear);
  return linear;
}

cv::Mat3b saturated_channels(const Frame& frame) {
  if (frame.color.empty()) return {};
  const double top = frame.color.depth() == CV_16U ? 65279 : 254;
  return cv::Mat(frame.color >= cv::Scalar::all(top));
}

cv::Mat1b saturated(const Frame& frame) {
  const cv::Mat3b channels = saturated_channels(frame);
  if (channels.empty()) return {};
  cv::Mat1b any;
  cv::reduce(channels.reshape(1, static_cast<int>(channels.total())), any, 1, cv::REDUCE_MAX);
  return any.reshape(1, channels.rows);
}

}  // namespace rakelight
