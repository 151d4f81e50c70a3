// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "stack/color_response.h"
#include "stack/errors.h"
#include "tests/simulate/small_rig.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using test::ideal_rig;
using test::message_of;
using test::real_rig;
using testing::HasSubstr;

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  return a.empty() || std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

bool same_scan(const Simulated& a, const Simulated& b) {
  bool same = a.stack.frames.size() == b.stack.frames.size() && same_bytes(a.stack.mask, b.stack.mask) &&
              same_bytes(a.truth.depth, b.truth.depth) && same_bytes(a.truth.normals, b.truth.normals) &&
              same_bytes(a.truth.albedo, b.truth.albedo) && a.stack.created == b.stack.created;
  for (std::size_t k = 0; same && k < a.stack.frames.size(); ++k) {
    same = same_bytes(a.stack.frames[k].color, b.stack.frames[k].color) &&
           same_bytes(a.stack.frames[k].depth, b.stack.frames[k].depth);
  }
  return same;
}

TEST(Simulate, TheSameSeedGivesTheSameBytes) {
  EXPECT_TRUE(same_scan(simulate_stack(real_rig()), simulate_stack(real_rig())));
}

TEST(Simulate, AnotherSeedGivesOtherBytesEverywhere) {
  SimulateOptions options = real_rig();
  const Simulated first = simulate_stack(options);
  options.seed = 2;
  const Simulated second = simulate_stack(options);
  for (std::size_t k = 0; k < first.stack.frames.size(); ++k) {
    EXPECT_FALSE(same_bytes(first.stack.frames[k].color, second.stack.frames[k].color)) << k;
    EXPECT_FALSE(same_bytes(first.stack.frames[k].depth, second.stack.frames[k].depth)) << k;
  }
}

TEST(Simulate, OneThreadAndTwoGiveTheSameBytes) {
  for (const SceneKind scene : {SceneKind::vase, SceneKind::coin, SceneKind::drape, SceneKind::sphere}) {
    SimulateOptions options = real_rig();
    options.scene.kind = scene;
    options.lamps.near = true;
    options.threads = 1;
    const Simulated one = simulate_stack(options);
    options.threads = 2;
    EXPECT_TRUE(same_scan(one, simulate_stack(options)));
  }
}

TEST(Simulate, TheExposureLetsTheShareAskedForClip) {
  for (const int bits : {8, 16}) {
    SimulateOptions options = real_rig();
    options.width = 160;
    options.height = 120;
    options.image.bits = bits;
    options.image.clip_share = 0.05;
    const Simulated scan = simulate_stack(options);
    double clipped = 0, all = 0;
    for (const Frame& frame : scan.stack.frames) {
      if (!frame.light) continue;
      const cv::Mat1b top = saturated(frame);
      clipped += cv::countNonZero(top);
      all += cv::countNonZero(scan.stack.mask);
    }
    EXPECT_NEAR(clipped / all, 0.05, 0.02) << bits;
  }
}

TEST(Simulate, AnIdealScanDoesNotClip) {
  SimulateOptions options = ideal_rig(SceneKind::vase);
  options.lamps.count = 8;
  for (const Frame& frame : simulate_stack(options).stack.frames)
    EXPECT_EQ(cv::countNonZero(saturated(frame)), 0);
}

TEST(Simulate, AnRgbImageHoldsOneLampAChannel) {
  SimulateOptions options = ideal_rig(SceneKind::sphere);
  options.lamps.rgb = true;
  options.lamps.count = 0;
  const Simulated scan = simulate_stack(options);
  ASSERT_EQ(scan.stack.lights.size(), 1U);
  EXPECT_EQ(scan.stack.lights[0].color, LampColor::rgb);
  ASSERT_EQ(scan.truth.lamps.size(), 3U);
  const cv::Mat& image = scan.stack.frames[0].color;
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      if (scan.stack.mask(v, u) == 0) continue;
      const cv::Vec3f n = scan.truth.normals(v, u);
      for (int c = 0; c < 3; ++c) {
        const LampTruth& lamp = scan.truth.lamps[static_cast<std::size_t>(c)];
        const double shading = 0.75 * lamp.direction.dot(Eigen::Vector3d(n[0], n[1], n[2])) + 0.25;
        const double expected = static_cast<double>(scan.truth.albedo(v, u)[c]) * lamp.strength[c] * shading;
        ASSERT_NEAR(image.at<cv::Vec3w>(v, u)[c] / 65535.0, std::max(0.0, expected), 2e-5);
      }
    }
  }
}

TEST(Simulate, CrosstalkIsUndoneByWhatTheStackSays) {
  SimulateOptions options = ideal_rig(SceneKind::sphere);
  const Simulated clean = simulate_stack(options);
  options.image.crosstalk = 0.1;
  options.image.clip_share = 0;
  const Simulated mixed = simulate_stack(options);
  EXPECT_FALSE(same_bytes(clean.stack.frames[0].color, mixed.stack.frames[0].color));
  const cv::Mat3f before = linear_color(clean.stack, clean.stack.frames[0]);
  const cv::Mat3f after = linear_color(mixed.stack, mixed.stack.frames[0]);
  const double gain = mixed.truth.lamps[0].strength.x() / clean.truth.lamps[0].strength.x();
  EXPECT_LT(cv::norm(gain * before(24, 32) - after(24, 32)), 1e-3);
}

TEST(Simulate, ADarkFrameHoldsAmbientLightOnly) {
  SimulateOptions options = real_rig();
  options.lamps.ambient = 0.1;
  options.image.read_noise = options.image.shot_noise = 0;
  options.image.clip_share = 0;
  const Simulated scan = simulate_stack(options);
  const Frame& dark = scan.stack.frames.front();
  ASSERT_FALSE(dark.light.has_value());
  const double ambient = cv::mean(dark.color, scan.stack.mask)[1];
  const double lit = cv::mean(scan.stack.frames[1].color, scan.stack.mask)[1];
  EXPECT_GT(ambient, 1);
  EXPECT_LT(ambient, 0.5 * lit);
  options.lamps.ambient = 0;
  EXPECT_EQ(cv::countNonZero(simulate_stack(options).stack.frames.front().color.reshape(1)), 0);
}

TEST(Simulate, MaskAndTruthCoverTheSamePixels) {
  const Simulated scan = simulate_stack(real_rig());
  for (int v = 0; v < scan.stack.mask.rows; ++v) {
    for (int u = 0; u < scan.stack.mask.cols; ++u) {
      const bool inside = scan.stack.mask(v, u) != 0;
      ASSERT_EQ(std::isfinite(scan.truth.depth(v, u)), inside);
      ASSERT_EQ(std::isfinite(scan.truth.normals(v, u)[2]), inside);
      ASSERT_EQ(std::isfinite(scan.truth.albedo(v, u)[0]), inside);
    }
  }
}

TEST(Simulate, MoreDepthFramesThanImagesComeWithoutColour) {
  SimulateOptions options = ideal_rig(SceneKind::sphere);
  options.depth.frames = 3;
  const LightStack stack = simulate_stack(options).stack;
  ASSERT_EQ(stack.frames.size(), 3U);
  EXPECT_FALSE(stack.frames[0].color.empty());
  EXPECT_TRUE(stack.frames[2].color.empty());
  EXPECT_FALSE(stack.frames[2].depth.empty());
}

TEST(Simulate, ReportsProgressAndStopsWhenTold) {
  double last = -1;
  simulate_stack(ideal_rig(SceneKind::sphere), [&last](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  });
  EXPECT_EQ(last, 1);
  EXPECT_THROW(simulate_stack(ideal_rig(SceneKind::sphere), [](double fraction) { return fraction < 0.3; }),
               Cancelled);
}

TEST(Simulate, OptionsOutOfRangeAreRefusedByName) {
  const auto message = [](const std::function<void(SimulateOptions&)>& spoil) {
    SimulateOptions options = ideal_rig(SceneKind::sphere);
    spoil(options);
    return message_of<UsageError>([&] { simulate_stack(options); });
  };
  EXPECT_THAT(message([](auto& o) { o.color_scale = 5; }), HasSubstr("colour scale is 5"));
  EXPECT_THAT(message([](auto& o) { o.width = 1 << 20; }), HasSubstr("depth grid width"));
  EXPECT_THAT(message([](auto& o) { o.lamps.count = 0; }), HasSubstr("number of lights"));
  EXPECT_THAT(message([](auto& o) { o.image.bits = 12; }), HasSubstr("bits"));
  EXPECT_THAT(message([](auto& o) { o.depth.noise_mm = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("depth noise"));
}

}  // namespace
}  // namespace rakelight
