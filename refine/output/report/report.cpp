// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/report/report.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "refine/depth_normals.h"
#include "refine/output/error_map.h"
#include "refine/output/pictures.h"
#include "refine/output/report/embedded.h"
#include "refine/output/report/frames.h"
#include "refine/output/report/pictures.h"
#include "refine/output/report/surface.h"
#include "refine/output/result_json.h"

namespace rakelight {
namespace {

using Json = nlohmann::ordered_json;
using Slots = std::map<std::string, std::string>;

constexpr int kHistogramBins = 81;

/// How much of the result the page can show: what makes it large.
struct Detail {
  int picture_side = 900, normals_side = 800, surface_samples = 200'000, thumbnail_side = kThumbnailSide;
  std::size_t thumbnails = kMostThumbnails;

  Detail reduced() const {
    return {picture_side * 3 / 4, normals_side * 3 / 4, surface_samples / 2, thumbnail_side * 3 / 4,
            thumbnails * 3 / 4};
  }
  bool reducible() const { return picture_side > 50; }
};

/// JSON as the content of a script element: no < in it, so nothing in it can end or open an element.
std::string as_element_text(std::string json) {
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) json.replace(at, 1, "\\u003c");
  return json;
}

/// Mean of the surface points, camera coordinates, metres.
Json centre_of(const RefineResult& result) {
  cv::Vec3d sum;
  double count = 0;
  for (int y = 0; y < result.depth.rows; ++y) {
    for (int x = 0; x < result.depth.cols; ++x) {
      const double z = result.depth(y, x);
      if (!std::isfinite(z)) continue;
      const Camera& c = result.camera;
      sum += z * cv::Vec3d((x - c.cx) / c.fx, (y - c.cy) / c.fy, 1);
      ++count;
    }
  }
  if (count > 0) sum /= count;
  return {sum[0], sum[1], sum[2]};
}

/// What the pages' scripts draw and result.json has not.
Json page_data(const RefineResult& result, const LightStack* stack, const cv::Mat3f& sensor_normals,
               const Detail& detail, double range_mm) {
  const cv::Rect box = object_box(result.depth);
  Json data = {
      {"name", stack ? std::filesystem::path(stack->origin).filename().string() : ""},
      {"centre_m", centre_of(result)},
      {"pixels", cv::countNonZero(result.depth == result.depth)},
      {"delta", delta_histogram(result, range_mm, kHistogramBins)},
      {"surface", report_surface(result, sensor_normals, box, detail.surface_samples, detail.normals_side)},
      {"frames_in_stack", stack ? stack->frames.size() : 0},
      {"frames", Json::array()}};
  if (stack) {
    data["frames"] = report_frames(*stack,
                                   result.thumbnails.empty()
                                       ? frame_thumbnails(*stack, cv::Mat(result.depth == result.depth))
                                       : result.thumbnails,
                                   detail.thumbnail_side, detail.thumbnails);
  }
  return data;
}

/// The page with {{name}} replaced: by a slot, else by the file of that name. What is put in is not searched again.
std::string filled(const Slots& slots) {
  const std::string_view page = embedded_file("page.html");
  std::string text;
  std::size_t at = 0;
  for (std::size_t open; (open = page.find("{{", at)) != std::string_view::npos;) {
    const std::size_t close = page.find("}}", open);
    const std::string name(page.substr(open + 2, close - open - 2));
    text += page.substr(at, open - at);
    const auto slot = slots.find(name);
    text += slot == slots.end() ? embedded_file(name) : std::string_view(slot->second);
    at = close + 2;
  }
  return text.append(page.substr(at));
}

std::string page_with(const RefineResult& result, const LightStack* stack, const cv::Mat3f& sensor_normals,
                      const Detail& detail) {
  const double range_mm = error_range_mm(result.depth, result.initial_depth);
  Slots slots =
      report_pictures(result, sensor_normals, object_box(result.depth), detail.picture_side, range_mm);
  const Json data = page_data(result, stack, sensor_normals, detail, range_mm);
  slots["result"] = as_element_text(result_json(result));
  slots["data"] = as_element_text(data.dump(-1, ' ', false, Json::error_handler_t::replace));
  return filled(slots);
}

}  // namespace

std::string report_html(const RefineResult& result, const LightStack* stack) {
  const cv::Mat3f sensor_normals = normals_in(object_box(result.depth), result.camera, result.initial_depth);
  Detail detail;
  std::string page = page_with(result, stack, sensor_normals, detail);
  while (page.size() > kMaxReportBytes && detail.reducible()) {
    detail = detail.reduced();
    page = page_with(result, stack, sensor_normals, detail);
  }
  return page;
}

}  // namespace rakelight
