// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/output/images.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stack/color_response.h"

namespace rakelight {
namespace {

bool finite(const cv::Vec3f& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

}  // namespace

double depth_unit(const cv::Mat1f& depth) {
  double deepest = 0;
  for (const float z : depth) {
    if (std::isfinite(z)) deepest = std::max(deepest, static_cast<double>(z));
  }
  for (double decade = 1e-6;; decade *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (deepest / (step * decade) <= 65535.0) return step * decade;
    }
  }
}

cv::Mat1w depth_picture(const cv::Mat1f& depth, double unit_m) {
  cv::Mat1w picture(depth.size(), static_cast<ushort>(0));
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const double z = depth(y, x);
      if (std::isfinite(z) && z > 0) picture(y, x) = cv::saturate_cast<ushort>(z / unit_m);
    }
  }
  return picture;
}

cv::Mat_<cv::Vec3w> normals_picture(const cv::Mat3f& normals) {
  cv::Mat_<cv::Vec3w> picture(normals.size(), cv::Vec3w::all(0));
  for (int y = 0; y < normals.rows; ++y) {
    for (int x = 0; x < normals.cols; ++x) {
      const cv::Vec3f& n = normals(y, x);
      if (!finite(n)) continue;
      const cv::Vec3f open_gl(n[0], -n[1], -n[2]);
      for (int c = 0; c < 3; ++c) picture(y, x)[c] = cv::saturate_cast<ushort>((open_gl[c] + 1) * 32767.5f);
    }
  }
  return picture;
}

float albedo_white(const cv::Mat3f& albedo) {
  std::vector<float> values;
  for (const cv::Vec3f& rho : albedo) {
    if (finite(rho)) values.push_back(std::max({rho[0], rho[1], rho[2]}));
  }
  if (values.empty()) return 1.0f;
  // The brightest thousandth are highlights and speckles: they may clip.
  const auto white = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * 999 / 1000);
  std::nth_element(values.begin(), white, values.end());
  return *white > 0 ? *white : 1.0f;
}

cv::Mat3b albedo_picture(const cv::Mat3f& albedo) {
  const ColorResponse srgb{ColorResponse::Kind::srgb, 1.0};
  const double white = albedo_white(albedo);
  cv::Mat3b picture(albedo.size(), cv::Vec3b::all(0));
  for (int y = 0; y < albedo.rows; ++y) {
    for (int x = 0; x < albedo.cols; ++x) {
      const cv::Vec3f& rho = albedo(y, x);
      if (!finite(rho)) continue;
      for (int c = 0; c < 3; ++c) {
        const double value = std::clamp(static_cast<double>(rho[c]) / white, 0.0, 1.0);
        picture(y, x)[c] = cv::saturate_cast<uchar>(encode(srgb, value) * 255);
      }
    }
  }
  return picture;
}

}  // namespace rakelight
