// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/pictures.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "refine/output/error_map.h"
#include "refine/output/images.h"
#include "refine/output/pictures.h"
#include "refine/output/report/encoding.h"

namespace rakelight {
namespace {

constexpr int kQuality = 85;

cv::Mat within(const cv::Mat& picture, int side) {
  const double shrink = static_cast<double>(side) / std::max(picture.cols, picture.rows);
  if (shrink >= 1) return picture;
  cv::Mat small;
  cv::resize(picture, small, {}, shrink, shrink, cv::INTER_AREA);
  return small;
}

cv::Mat3b painted(const cv::Mat3f& normals) {
  cv::Mat3b picture;
  normals_picture(normals).convertTo(picture, CV_8U, 1.0 / 257.0);
  return picture;
}

}  // namespace

std::map<std::string, std::string> report_pictures(const RefineResult& result,
                                                   const cv::Mat3f& sensor_normals, const cv::Rect& box,
                                                   int side, double range_mm) {
  const cv::Mat3f &before = sensor_normals, after = result.normals(box);
  const cv::Mat3b delta = error_map(result.depth(box), result.initial_depth(box), range_mm);
  const std::vector<std::pair<std::string, cv::Mat>> pictures{{"relief_before", raking_light(before)},
                                                              {"relief_after", raking_light(after)},
                                                              {"normals_before", painted(before)},
                                                              {"normals_after", painted(after)},
                                                              {"albedo", albedo_picture(result.albedo(box))},
                                                              {"delta", delta}};
  std::map<std::string, std::string> uris;
  for (const auto& [name, picture] : pictures) uris[name] = jpeg_uri(within(picture, side), kQuality);
  return uris;
}

nlohmann::ordered_json delta_histogram(const RefineResult& result, double range_mm, int bins) {
  std::vector<int> counts(static_cast<std::size_t>(bins), 0);
  int below = 0, above = 0, all = 0;
  double sum = 0, squares = 0;
  const cv::Mat1f change(result.depth - result.initial_depth);
  for (const float metres : change) {
    if (!std::isfinite(metres)) continue;
    const double mm = 1e3 * static_cast<double>(metres);
    const double place = (mm / range_mm + 1) / 2 * bins;
    if (place < 0)
      ++below;
    else if (place >= bins)
      ++above;
    else
      ++counts[static_cast<std::size_t>(place)];
    ++all;
    sum += mm;
    squares += mm * mm;
  }
  const double n = std::max(1, all);
  return {{"range_mm", range_mm}, {"counts", counts},   {"below", below},
          {"above", above},       {"mean_mm", sum / n}, {"rms_mm", std::sqrt(squares / n)}};
}

}  // namespace rakelight
