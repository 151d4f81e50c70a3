// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any stack the types can hold within the format's bounds survives a manifest unchanged.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>

#include "stack/errors.h"
#include "stack/manifest.h"
#include "tests/support/small_stack.h"

namespace rakelight {
namespace {

double number(double lowest, double highest) {
  const double unit = *rc::gen::inRange(0, 1'000'000'001) / 1e9;
  return lowest + (highest - lowest) * unit;
}

template <typename Make>
auto maybe(const Make& make) -> std::optional<decltype(make())> {
  if (*rc::gen::arbitrary<bool>()) return make();
  return {};
}

/// Text of printable characters, quotes and backslashes among them.
std::string text() { return *rc::gen::container<std::string>(rc::gen::inRange<char>(' ', '~' + 1)); }

Camera camera() {
  Camera result;
  result.width = *rc::gen::inRange(1, 4001);
  result.height = *rc::gen::inRange(1, 4001);
  result.fx = number(0.001, 1e6);
  result.fy = number(0.001, 1e6);
  result.cx = number(-1e6, 1e6);
  result.cy = number(-1e6, 1e6);
  result.distortion.resize(*rc::gen::element<std::size_t>(0, 4, 5, 8));
  for (double& k : result.distortion) k = number(-10, 10);
  return result;
}

Eigen::Matrix4d rigid() {
  const Eigen::Vector3d axis = Eigen::Vector3d(number(-1, 1), number(-1, 1), 1.5).normalized();
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = Eigen::AngleAxisd(number(-3, 3), axis).toRotationMatrix();
  T.topRightCorner<3, 1>() = Eigen::Vector3d(number(-5, 5), number(-5, 5), number(-5, 5));
  return T;
}

ColorResponse response() {
  ColorResponse result;
  result.kind =
      *rc::gen::element(ColorResponse::Kind::linear, ColorResponse::Kind::srgb, ColorResponse::Kind::gamma);
  if (result.kind == ColorResponse::Kind::gamma) result.gamma = number(0.01, 100);
  return result;
}

std::vector<Light> lights() {
  std::vector<Light> result(*rc::gen::inRange<std::size_t>(0, 6));
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i].id = std::to_string(i) + text();
    result[i].color = *rc::gen::element(LampColor::red, LampColor::green, LampColor::blue, LampColor::white,
                                        LampColor::rgb);
    result[i].line = maybe([] { return *rc::gen::inRange(0, 1000); });
    result[i].position_m = maybe([] { return Eigen::Vector3d(number(-9, 9), number(-9, 9), number(-9, 9)); });
  }
  return result;
}

Timestamp timestamp() {
  const auto microseconds = [] { return *rc::gen::arbitrary<std::int64_t>(); };
  Timestamp time{maybe(microseconds), maybe(microseconds)};
  RC_PRE(time.device_us != INT64_MIN && time.host_us != INT64_MIN);
  return time;
}

LitCheck lit_check() {
  LitCheck check;
  for (auto& row : check.rows_rgb) {
    for (double& value : row) value = number(-0.1, 1);
  }
  check.matches = *rc::gen::arbitrary<bool>();
  return check;
}

Frame frame(int index, const std::vector<Light>& lights) {
  Frame result;
  result.index = index;
  if (!lights.empty()) result.light = maybe([&] { return (*rc::gen::elementOf(lights)).id; });
  result.color_time = timestamp();
  result.depth_time = timestamp();
  result.led_edge_time = timestamp();
  result.lit_check = maybe(lit_check);
  return result;
}

Manifest arbitrary_manifest() {
  Manifest manifest;
  LightStack& stack = manifest.stack;
  stack.created = text();
  stack.sensor = {text(), text(), text(), text(), text()};
  stack.color_camera = camera();
  stack.depth_camera = camera();
  stack.T_color_depth = rigid();
  stack.depth_unit_m = number(1e-9, 1);
  stack.color_response = response();
  stack.color_crosstalk(0, 1) = number(-0.5, 0.5);
  stack.exposure_us = maybe([] { return number(0, 1e12); });
  stack.gain = maybe([] { return number(0, 1e9); });
  stack.white_balance = maybe([] { return WhiteBalance{number(0, 9), number(0, 9), number(0, 9)}; });
  stack.lights = lights();
  const int count = *rc::gen::inRange(1, 8);
  for (int i = 0; i < count; ++i) {
    stack.frames.push_back(frame(3 * i, stack.lights));
    const std::string name = std::to_string(i) + text();
    manifest.files.push_back({"c/" + name, i % 2 == 0 ? "" : "d/" + name});
  }
  if (*rc::gen::arbitrary<bool>()) stack.unknown_keys = R"({"frames":{"0":{"x":1}},"rig":[1.5,"y"]})";
  return manifest;
}

TEST(ManifestProperty, any_manifest_comes_back_the_same) {
  const bool passed = rc::check([] {
    const Manifest written = arbitrary_manifest();
    const Manifest read = parse_manifest(manifest_text(written.stack, written.files), "stack.json");
    test::expect_same(written.stack, read.stack);
    RC_ASSERT(written.files.size() == read.files.size());
    for (std::size_t i = 0; i < read.files.size(); ++i) {
      RC_ASSERT(written.files[i].color == read.files[i].color);
      RC_ASSERT(written.files[i].depth == read.files[i].depth);
    }
    RC_ASSERT(!testing::Test::HasFailure());
  });
  EXPECT_TRUE(passed);
}

TEST(ManifestProperty, any_manifest_spoilt_at_random_is_refused_or_read_but_never_worse) {
  const bool passed = rc::check([] {
    const Manifest manifest = arbitrary_manifest();
    std::string text = manifest_text(manifest.stack, manifest.files);
    const int edits = *rc::gen::inRange(1, 10);
    for (int i = 0; i < edits; ++i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
      text[at] = *rc::gen::arbitrary<char>();
    }
    try {
      parse_manifest(text, "stack.json");
    } catch (const InputError&) {}
  });
  EXPECT_TRUE(passed);
}

}  // namespace
}  // namespace rakelight
