// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/surface.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "refine/output/report/encoding.h"

namespace rakelight {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kNormalQuality = 90;  ///< JPEG; about a degree of the normal

/// Every stride-th pixel of the box.
cv::Mat1f sampled(const cv::Mat1f& depth, const cv::Rect& box, int stride) {
  cv::Mat1f samples((box.height + stride - 1) / stride, (box.width + stride - 1) / stride);
  for (int y = 0; y < samples.rows; ++y) {
    for (int x = 0; x < samples.cols; ++x) samples(y, x) = depth(box.y + y * stride, box.x + x * stride);
  }
  return samples;
}

struct Range {
  float near = std::numeric_limits<float>::max(), far = 0;

  void hold(const cv::Mat1f& depth) {
    for (const float z : depth) {
      if (!std::isfinite(z)) continue;
      near = std::min(near, z);
      far = std::max(far, z);
    }
  }
};

/// 0 where there is no depth, else 1 (near) to 65535 (far), little-endian.
std::string codes(const cv::Mat1f& depth, const Range& range) {
  const float step = std::max(range.far - range.near, 1e-9f) / 65534;
  std::vector<std::uint16_t> values;
  values.reserve(depth.total());
  for (const float z : depth)
    values.push_back(std::isfinite(z) ? cv::saturate_cast<ushort>(1 + (z - range.near) / step) : ushort{0});
  return base64(values.data(), values.size() * sizeof(values[0]));
}

/// x and y side by side, 0 = -1 to 255 = 1; averaged over the pixels that have a normal.
cv::Mat1b normal_pair(const cv::Mat3f& normals, const cv::Size& size) {
  cv::Mat3f known = normals.clone();
  for (cv::Vec3f& n : known) {
    if (!std::isfinite(n[0] + n[1] + n[2])) n = cv::Vec3f::all(0);
  }
  cv::resize(known, known, size, 0, 0, cv::INTER_AREA);
  cv::Mat1b pair(size.height, 2 * size.width);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const cv::Vec3f n = cv::normalize(known(y, x));  // of zero: zero
      pair(y, x) = cv::saturate_cast<uchar>((n[0] + 1) * 127.5f);
      pair(y, x + size.width) = cv::saturate_cast<uchar>((n[1] + 1) * 127.5f);
    }
  }
  return pair;
}

}  // namespace

Json report_surface(const RefineResult& result, const cv::Mat3f& sensor_normals, const cv::Rect& box,
                    int samples, int side) {
  const int stride =
      std::max(1, static_cast<int>(std::ceil(std::sqrt(box.area() / static_cast<double>(samples)))));
  const cv::Mat1f refined = sampled(result.depth, box, stride),
                  sensor = sampled(result.initial_depth, box, stride);
  Range range;
  range.hold(refined);
  range.hold(sensor);
  const double shrink = std::min(1.0, static_cast<double>(side) / std::max(box.width, box.height));
  const cv::Size size(std::max(1, cvRound(box.width * shrink)), std::max(1, cvRound(box.height * shrink)));
  cv::Mat1b normals;
  cv::vconcat(normal_pair(result.normals(box), size), normal_pair(sensor_normals, size), normals);
  return {{"x", box.x},
          {"y", box.y},
          {"width", box.width},
          {"height", box.height},
          {"stride", stride},
          {"columns", refined.cols},
          {"rows", refined.rows},
          {"near_m", range.near},
          {"far_m", range.far},
          {"refined", codes(refined, range)},
          {"sensor", codes(sensor, range)},
          {"normals", jpeg_uri(normals, kNormalQuality)}};
}

}  // namespace rakelight
