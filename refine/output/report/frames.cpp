// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/frames.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "refine/output/report/encoding.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kQuality = 80;
constexpr double kHighlights = 0.005;  ///< share of the pixels that may clip in the page

struct Preview {
  cv::Mat3f linear;
  double clipped = 0;  ///< share of the object
};

/// The box on an image of another size than its grid.
cv::Rect on_image(const cv::Rect& box, const cv::Size& grid, const cv::Size& image) {
  const double sx = static_cast<double>(image.width) / grid.width,
               sy = static_cast<double>(image.height) / grid.height;
  const cv::Rect scaled(cvFloor(box.x * sx), cvFloor(box.y * sy), cvCeil(box.width * sx),
                        cvCeil(box.height * sy));
  return scaled & cv::Rect({0, 0}, image);
}

Preview preview(const LightStack& stack, const Frame& frame, const cv::Mat1b& surface, const cv::Rect& box,
                int side) {
  Frame cropped = frame;
  cropped.color = frame.color(on_image(box, surface.size(), frame.color.size()));
  cv::Mat1b object;
  cv::resize(surface(box), object, cropped.color.size(), 0, 0, cv::INTER_NEAREST);
  const int clipped = cv::countNonZero(saturated(cropped) & object);
  const double shrink =
      std::min(1.0, static_cast<double>(side) / std::max(cropped.color.cols, cropped.color.rows));
  if (shrink < 1) {
    const cv::Size size(std::max(1, cvRound(cropped.color.cols * shrink)),
                        std::max(1, cvRound(cropped.color.rows * shrink)));
    cv::resize(cropped.color.clone(), cropped.color, size, 0, 0, cv::INTER_AREA);
  }
  return {linear_color(stack, cropped), static_cast<double>(clipped) / std::max(1, cv::countNonZero(object))};
}

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

Json json_of(const LightStack& stack, const Frame& frame, const Preview& preview, float white) {
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

Json report_frames(const LightStack& stack, const cv::Mat1b& surface, const cv::Rect& box, int side,
                   std::size_t count) {
  std::vector<const Frame*> shown;
  for (const Frame& frame : stack.frames) {
    if (!frame.color.empty() && shown.size() < count) shown.push_back(&frame);
  }
  std::vector<Preview> previews(shown.size());
  cv::parallel_for_({0, static_cast<int>(shown.size())}, [&](const cv::Range& range) {
    for (auto k = static_cast<std::size_t>(range.start); k < static_cast<std::size_t>(range.end); ++k)
      previews[k] = preview(stack, *shown[k], surface, box, side);
  });
  const float white = white_of(previews);
  Json list = Json::array();
  for (std::size_t k = 0; k < shown.size(); ++k)
    list.push_back(json_of(stack, *shown[k], previews[k], white));
  return list;
}

}  // namespace rakelight
