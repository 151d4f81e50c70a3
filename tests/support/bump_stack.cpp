// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/bump_stack.h"

#include <cmath>
#include <limits>
#include <random>

namespace rakelight::test {
namespace {

const Camera kColor{96, 72, 140.0, 140.0, 47.5, 35.5, {}};
constexpr int kBorder = 6;  ///< pixels of colour around the mask
constexpr int kLamps = 8;
constexpr double kDepthUnit = 0.0001;

/// Depth and normal where the ray of a pixel (which may be fractional) meets the surface, by fixed-point iteration on
/// z = height(x, y) with x = ray.x z.
struct Hit {
  double z;
  cv::Vec3d normal;
};

Hit hit(double u, double v) {
  const double ray_x = (u - kColor.cx) / kColor.fx, ray_y = (v - kColor.cy) / kColor.fy;
  const double radius = 0.08, height = 0.03;
  Hit result{0.6, {}};
  for (int i = 0; i < 50; ++i) {
    const double x = ray_x * result.z, y = ray_y * result.z;
    const double bump = height * std::exp(-(x * x + y * y) / (radius * radius));
    result.z = 0.6 + 0.1 * x - bump;
    const double dz_dx = 0.1 + 2 * x / (radius * radius) * bump, dz_dy = 2 * y / (radius * radius) * bump;
    result.normal = cv::normalize(cv::Vec3d(dz_dx, dz_dy, -1));
  }
  return result;
}

cv::Vec3d lamp_direction(int lamp) {
  const double angle = 2 * CV_PI * lamp / kLamps;
  return cv::normalize(cv::Vec3d(0.6 * std::cos(angle), 0.6 * std::sin(angle), -1));
}

cv::Mat lit_image(int lamp) {
  cv::Mat_<cv::Vec3w> image(kColor.size());
  const cv::Vec3d direction = lamp_direction(lamp), albedo(0.8, 0.6, 0.4);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double shading = std::max(0.0, hit(x, y).normal.dot(direction));
      image(y, x) = albedo * shading * 60000.0;
    }
  }
  return image;
}

cv::Mat1w sensor_depth(std::mt19937& random) {
  const Camera camera = binned(kColor, 2);
  std::normal_distribution<double> noise(0, 0.001);
  cv::Mat1w depth(camera.size());
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth(y, x) = cv::saturate_cast<ushort>((hit(2 * x + 0.5, 2 * y + 0.5).z + noise(random)) / kDepthUnit);
    }
  }
  return depth;
}

cv::Rect object() { return {kBorder, kBorder, kColor.width - 2 * kBorder, kColor.height - 2 * kBorder}; }

}  // namespace

LightStack bump_stack() {
  std::mt19937 random(1);
  LightStack stack;
  stack.created = "2026-01-01T00:00:00Z";
  stack.color_camera = kColor;
  stack.depth_camera = binned(kColor, 2);
  stack.depth_unit_m = kDepthUnit;
  for (int i = 0; i < kLamps; ++i) {
    const std::string id = "lamp-" + std::to_string(i);
    stack.lights.push_back({id, LampColor::white, {}, {}});
    Frame frame;
    frame.index = i;
    frame.light = id;
    frame.color = lit_image(i);
    frame.depth = sensor_depth(random);
    stack.frames.push_back(frame);
  }
  stack.mask = cv::Mat1b(kColor.size(), uchar{0});
  stack.mask(object()).setTo(255);
  return stack;
}

GroundTruth bump_truth() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  GroundTruth truth;
  truth.depth = cv::Mat1f(kColor.size(), nan);
  truth.normals = cv::Mat3f(kColor.size(), cv::Vec3f::all(nan));
  const cv::Rect inside = object();
  for (int y = inside.y; y < inside.br().y; ++y) {
    for (int x = inside.x; x < inside.br().x; ++x) {
      const Hit surface = hit(x, y);
      truth.depth(y, x) = static_cast<float>(surface.z);
      truth.normals(y, x) = surface.normal;
    }
  }
  return truth;
}

}  // namespace rakelight::test
