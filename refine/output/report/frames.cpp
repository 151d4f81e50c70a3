// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/frames.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "refine/output/report/encoding.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kQuality = 80;
constexpr double kHighlights = 0.005;  ///< share of the pixels that may clip in the page

struct Preview {
  const Frame& frame;
  double clipped = 0;  ///< share of the object
  cv::Mat3f linear;
};

/// Radiance that nearly no pixel of any frame exceeds.
float white_of(const std::vector<Preview>& previews) {
  float white = 1e-6f;
  for (const Preview& each : previews) {
    std::vector<float> values;
    for (const cv::Vec3f& v : each.linear) values.push_back(std::max({v[0], v[1], v[2]}));
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(static_cast<double>(values.size() - 1) * (1 - kHighlights));
    std::nth_element(values.begin(), at, values.end());
    white = std::max(white, *at);
  }
  return white;
}

cv::Mat3b as_srgb(const cv::Mat3f& linear, float white) {
  const ColorResponse srgb{ColorResponse::Kind::srgb, 1.0};
  cv::Mat3b picture(linear.size());
  std::transform(linear.begin(), linear.end(), picture.begin(), [&](const cv::Vec3f& v) {
    cv::Vec3b color;
    for (int c = 0; c < 3; ++c)
      color[c] = cv::saturate_cast<uchar>(
          255 * encode(srgb, std::clamp(static_cast<double>(v[c] / white), 0.0, 1.0)));
    return color;
  });
  return picture;
}

Json json_of(const LightStack& stack, const Preview& preview, float white) {
  const Frame& frame = preview.frame;
  Json json = {{"index", frame.index}, {"lamp", nullptr}, {"color", nullptr}, {"lit", nullptr}};
  if (frame.light) json["lamp"] = *frame.light;
  const auto light = std::find_if(stack.lights.begin(), stack.lights.end(),
                                  [&](const Light& each) { return frame.light && each.id == *frame.light; });
  if (light != stack.lights.end()) json["color"] = to_string(light->color);
  if (frame.lit_check) json["lit"] = frame.lit_check->matches;
  json["clipped"] = preview.clipped;
  json["picture"] = jpeg_uri(as_srgb(preview.linear, white), kQuality);
  return json;
}

}  // namespace

Json report_frames(const LightStack& stack, const std::vector<FrameThumbnail>& pictures, int side,
                   std::size_t count) {
  std::vector<Preview> previews;
  for (const FrameThumbnail& picture : pictures) {
    if (previews.size() == count) break;
    Frame small;
    small.color = shrunk(picture.color, side);
    previews.push_back({stack.frames.at(picture.frame), picture.clipped, linear_color(stack, small)});
  }
  const float white = white_of(previews);
  Json list = Json::array();
  for (const Preview& preview : previews) list.push_back(json_of(stack, preview, white));
  return list;
}

}  // namespace rakelight
