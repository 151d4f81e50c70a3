// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/small_stack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stack/color_response.h"

namespace rakelight::test {
namespace {

const cv::Size kColorSize(24, 16), kDepthSize(12, 8);

cv::Mat color_image(int bits, int seed) {
  cv::Mat image(kColorSize, bits == 16 ? CV_16UC3 : CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  random.fill(image, cv::RNG::UNIFORM, 10, bits == 16 ? 60000 : 240);
  return image;
}

cv::Mat1w depth_image(int seed) {
  cv::Mat1w image(kDepthSize);
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1000);
  random.fill(image, cv::RNG::UNIFORM, 9000, 11000);
  image(0, 0) = 0;
  return image;
}

Frame frame(int index, int bits, int generation) {
  Frame result;
  result.index = index;
  const int seed = 100 * generation + index;
  result.color = color_image(bits, seed);
  if (index != 3) result.depth = depth_image(seed);
  result.color_time = {1000000 + index, 2000000};
  result.depth_time.device_us = 1000 + index;
  result.led_edge_time.host_us = std::numeric_limits<std::int64_t>::max();
  return result;
}

void expect_same(const Camera& a, const Camera& b) {
  EXPECT_EQ(a.size(), b.size());
  EXPECT_EQ(a.fx, b.fx);
  EXPECT_EQ(a.fy, b.fy);
  EXPECT_EQ(a.cx, b.cx);
  EXPECT_EQ(a.cy, b.cy);
  EXPECT_EQ(a.distortion, b.distortion);
}

void expect_same(const Timestamp& a, const Timestamp& b) {
  EXPECT_EQ(a.device_us, b.device_us);
  EXPECT_EQ(a.host_us, b.host_us);
}

void expect_same(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.light, b.light);
  EXPECT_TRUE(same_pixels(a.color, b.color)) << "colour of frame " << a.index;
  EXPECT_TRUE(same_pixels(a.depth, b.depth)) << "depth of frame " << a.index;
  expect_same(a.color_time, b.color_time);
  expect_same(a.depth_time, b.depth_time);
  expect_same(a.led_edge_time, b.led_edge_time);
  ASSERT_EQ(a.lit_check.has_value(), b.lit_check.has_value());
  if (!a.lit_check) return;
  EXPECT_EQ(a.lit_check->rows_rgb, b.lit_check->rows_rgb);
  EXPECT_EQ(a.lit_check->matches, b.lit_check->matches);
}

void expect_same(const Light& a, const Light& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.line, b.line);
  EXPECT_EQ(a.position_m, b.position_m);
}

void expect_same(const Sensor& a, const Sensor& b) {
  EXPECT_EQ(a.vendor, b.vendor);
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.uri, b.uri);
  EXPECT_EQ(a.serial, b.serial);
  EXPECT_EQ(a.driver, b.driver);
}

}  // namespace

LightStack small_stack(int bits, int generation) {
  LightStack stack;
  stack.created = "2026-01-02T03:04:05Z generation " + std::to_string(generation);
  stack.sensor = {"Vendor", "Näme", "1d27/0609@2/1", "serial \"7\"", "openni2"};
  stack.color_camera = {kColorSize.width,         kColorSize.height, 30.25, 30.5, 11.5, 7.5,
                        {0.1, -0.2, 1e-3, 0, 0.5}};
  stack.depth_camera = {kDepthSize.width, kDepthSize.height, 15.1, 15.2, 5.5, 3.5, {}};
  stack.T_color_depth(0, 3) = 0.001;
  stack.depth_unit_m = 1e-4;
  stack.color_response = {ColorResponse::Kind::gamma, 2.2};
  stack.color_crosstalk << 1, 0.1, 0, 0.05, 0.9, 0.1, 0, 0.02, 1;
  stack.exposure_us = 8333.5;
  stack.gain = 1.5;
  stack.white_balance = WhiteBalance{1.5, 1, 1.75};
  stack.lights = {{"red", LampColor::red, 17, Eigen::Vector3d(0.1, -0.2, 0.3)},
                  {"white", LampColor::white, 27, {}},
                  {"all", LampColor::rgb, {}, Eigen::Vector3d(1.0 / 3, 0, -0.5)},
                  {"blue", LampColor::blue, {}, {}}};
  for (int i = 0; i < 5; ++i) {
    stack.frames.push_back(frame(i, bits, generation));
    if (i < 4) stack.frames.back().light = stack.lights[std::size_t(i)].id;
  }
  stack.frames[1].lit_check = LitCheck{{{{0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, {0.7, 0.8, 1.0 / 3}}}, true};
  stack.mask = cv::Mat1b(kColorSize, 0);
  stack.mask(cv::Rect(2, 2, 20, 12)) = 255;
  return stack;
}

GroundTruth small_truth() {
  GroundTruth truth;
  truth.depth = cv::Mat1f(kColorSize, 1.0f);
  truth.normals = cv::Mat3f(kColorSize, cv::Vec3f(0.6f, 0, -0.8f));
  truth.albedo = cv::Mat3f(kColorSize, cv::Vec3f(0.9f, 0.5f, 0.1f));
  truth.depth(3, 5) = 1.25f;
  truth.depth(0, 0) = std::nanf("");
  truth.normals(0, 0) = cv::Vec3f::all(std::nanf(""));
  truth.lamps = {
      {"red", LampColor::red, true, Eigen::Vector3d(0.1, 0.2, 0.3), Eigen::Vector3d(0, 0, -1),
       Eigen::Vector3d(1, 0, 0)},
      {"white", LampColor::white, false, {}, Eigen::Vector3d(0.6, 0, -0.8), Eigen::Vector3d(1, 2, 1.0 / 3)}};
  return truth;
}

bool same_pixels(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() && b.empty()) return true;
  return a.type() == b.type() && a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

void expect_same(const LightStack& a, const LightStack& b) {
  EXPECT_EQ(a.created, b.created);
  expect_same(a.sensor, b.sensor);
  expect_same(a.color_camera, b.color_camera);
  expect_same(a.depth_camera, b.depth_camera);
  EXPECT_EQ(a.T_color_depth, b.T_color_depth);
  EXPECT_EQ(a.depth_unit_m, b.depth_unit_m);
  EXPECT_EQ(to_string(a.color_response), to_string(b.color_response));
  EXPECT_EQ(a.color_crosstalk, b.color_crosstalk);
  EXPECT_EQ(a.exposure_us, b.exposure_us);
  EXPECT_EQ(a.gain, b.gain);
  ASSERT_EQ(a.white_balance.has_value(), b.white_balance.has_value());
  if (a.white_balance) {
    EXPECT_EQ(a.white_balance->red, b.white_balance->red);
    EXPECT_EQ(a.white_balance->green, b.white_balance->green);
    EXPECT_EQ(a.white_balance->blue, b.white_balance->blue);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) expect_same(a.lights[i], b.lights[i]);
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) expect_same(a.frames[i], b.frames[i]);
  EXPECT_TRUE(same_pixels(a.mask, b.mask)) << "mask";
  EXPECT_EQ(a.unknown_keys, b.unknown_keys);
}

}  // namespace rakelight::test
