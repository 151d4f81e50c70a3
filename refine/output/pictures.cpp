// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "refine/depth_normals.h"
#include "refine/output/images.h"

namespace rakelight {
namespace {

constexpr int kPanelSide = 960;  ///< pixels, longest side of one of the four pictures
constexpr int kCaptionHeight = 36;

/// From the surface to the lamps: one low at the upper left, a weak one at the camera.
const cv::Vec3f kRakingLamp = cv::normalize(cv::Vec3f(-1.0f, -0.7f, -0.55f));
constexpr float kRakingShare = 0.85f, kHeadShare = 0.15f;

cv::Mat3b shaded(const cv::Mat3f& normals) {
  cv::Mat3b picture;
  cv::cvtColor(raking_light(normals), picture, cv::COLOR_GRAY2RGB);
  return picture;
}

cv::Mat3b painted(const cv::Mat3f& normals) {
  cv::Mat3b picture;
  normals_picture(normals).convertTo(picture, CV_8U, 1.0 / 257.0);
  return picture;
}

/// Shrinks or (small objects) enlarges by whole pixels, and writes the caption above.
cv::Mat3b panel(const cv::Mat3b& picture, const std::string& caption) {
  const double fit = static_cast<double>(kPanelSide) / std::max(picture.cols, picture.rows);
  const double zoom = fit >= 1 ? std::floor(std::min(fit, 4.0)) : fit;
  cv::Mat3b scaled;
  cv::resize(picture, scaled, {}, zoom, zoom, zoom < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  cv::Mat3b result(scaled.rows + kCaptionHeight, scaled.cols, cv::Vec3b::all(0));
  scaled.copyTo(result(cv::Rect({0, kCaptionHeight}, scaled.size())));
  cv::putText(result, caption, {8, 25}, cv::FONT_HERSHEY_SIMPLEX, 0.7, cv::Scalar::all(235), 1, cv::LINE_AA);
  return result;
}

/// Two pairs: beside each other for a tall object, one below the other for a wide one.
cv::Mat3b arranged(const std::array<cv::Mat3b, 4>& panels, bool tall) {
  cv::Mat3b first, second, all;
  cv::hconcat(panels[0], panels[1], first);
  cv::hconcat(panels[2], panels[3], second);
  tall ? cv::hconcat(first, second, all) : cv::vconcat(first, second, all);
  return all;
}

}  // namespace

cv::Rect object_box(const cv::Mat1f& depth) {
  cv::Mat1b valid(depth.size());
  std::transform(depth.begin(), depth.end(), valid.begin(),
                 [](float z) { return static_cast<uchar>(std::isfinite(z) ? 255 : 0); });
  return object_box(valid);
}

cv::Mat1b raking_light(const cv::Mat3f& normals) {
  cv::Mat1b picture(normals.size(), static_cast<uchar>(0));
  for (int y = 0; y < normals.rows; ++y) {
    for (int x = 0; x < normals.cols; ++x) {
      const cv::Vec3f& n = normals(y, x);
      if (!std::isfinite(n[0]) || !std::isfinite(n[1]) || !std::isfinite(n[2])) continue;
      const float light =
          kRakingShare * std::max(0.0f, n.dot(kRakingLamp)) + kHeadShare * std::max(0.0f, -n[2]);
      picture(y, x) = cv::saturate_cast<uchar>(20.0f + 235.0f * std::sqrt(light));
    }
  }
  return picture;
}

cv::Mat3b before_after_picture(const RefineResult& result) {
  const cv::Rect box = object_box(result.depth);
  const cv::Mat3f before = normals_in(box, result.camera, result.initial_depth), after = result.normals(box);
  return arranged({panel(shaded(before), "sensor depth"), panel(shaded(after), "refined"),
                   panel(painted(before), "sensor normals"), panel(painted(after), "refined normals")},
                  box.height > box.width);
}

}  // namespace rakelight
