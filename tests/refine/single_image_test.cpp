// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The methods that use one image, from stack to surface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "refine/evaluate.h"
#include "refine/refine.h"
#include "stack/errors.h"
#include "tests/support/bump_stack.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

/// A bump lit by a red, a green and a blue lamp in turn; the depth is on colour's grid binned by two.
LightStack color_lit_bump() {
  LightStack stack = test::bump_stack();
  const std::vector<Frame> all = std::exchange(stack.frames, {});
  const LampColor colors[] = {LampColor::red, LampColor::green, LampColor::blue};
  const size_t lamps[] = {0, 3, 6};
  for (size_t c = 0; c < 3; ++c) {
    stack.frames.push_back(all[lamps[c]]);
    stack.lights[lamps[c]].color = colors[c];
  }
  return stack;
}

RefineOptions options_of(Method method, Preset preset = Preset::robust) {
  RefineOptions options = preset_options(preset, method);
  options.scale = 1;
  return options;
}

void expect_finite(const RefineResult& result) {
  const cv::Mat1b surface = cv::Mat(result.depth == result.depth);
  EXPECT_EQ(cv::countNonZero(surface), cv::countNonZero(cv::Mat(result.initial_depth > 0)));
  for (const cv::Vec3f& n : cv::Mat_<cv::Vec3f>(result.normals)) {
    if (!std::isnan(n[0])) { EXPECT_NEAR(cv::norm(n), 1, 1e-4); }
  }
  for (const IterationReport& report : result.iterations) EXPECT_TRUE(std::isfinite(report.energy));
}

class EverySingleImageMethod : public testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(, EverySingleImageMethod,
                         testing::Values(Method::rgb_ratio, Method::fusion_like, Method::rgbd_fusion));

TEST_P(EverySingleImageMethod, BringsTheSurfaceNearerToTheTruth) {
  const RefineResult result = refine_depth(color_lit_bump(), options_of(GetParam()));
  const Evaluation before = evaluate(result.camera, result.initial_depth, {}, test::bump_truth());
  const Evaluation after = evaluate(result.camera, result.depth, result.normals, test::bump_truth());
  EXPECT_LT(after.rmse_mm, before.rmse_mm);
  EXPECT_LT(after.mae_deg, (GetParam() == Method::rgb_ratio ? 0.5 : 0.9) * before.mae_deg);
  expect_finite(result);
}

TEST_P(EverySingleImageMethod, TakesSecondOrderHarmonics) {
  for (const Preset preset : {Preset::robust, Preset::paper}) {
    RefineOptions options = options_of(GetParam(), preset);
    options.lamps.harmonics = 2;
    const RefineResult result = refine_depth(color_lit_bump(), options);
    expect_finite(result);
    EXPECT_TRUE(result.lights.front().second_order_rgb);
  }
}

TEST_P(EverySingleImageMethod, NeverRaisesTheEnergyInADepthStep) {
  const RefineResult result = refine_depth(color_lit_bump(), options_of(GetParam()));
  ASSERT_FALSE(result.iterations.empty());
  for (const IterationReport& report : result.iterations)
    EXPECT_LE(report.energy, report.energy_before_depth) << report.index;
}

TEST_P(EverySingleImageMethod, InPresetPaperEndsWithAWordAndAFiniteSurface) {
  const RefineResult result = refine_depth(color_lit_bump(), options_of(GetParam(), Preset::paper));
  expect_finite(result);
  EXPECT_THAT(result.message, testing::AnyOf(HasSubstr("stopped"), HasSubstr("settled")));
}

TEST_P(EverySingleImageMethod, RefusesBlackAndSaturatedImagesAndAMaskOfNextToNothing) {
  const auto refusal = [](const LightStack& stack) {
    return test::message_of<InputError>([&] { refine_depth(stack, options_of(GetParam())); });
  };
  LightStack black = color_lit_bump(), saturated = color_lit_bump(), speck = color_lit_bump();
  for (Frame& frame : black.frames) frame.color = cv::Mat::zeros(frame.color.size(), frame.color.type());
  for (Frame& frame : saturated.frames)
    frame.color = cv::Mat(frame.color.size(), frame.color.type(), cv::Scalar::all(65535));
  speck.mask.setTo(0);
  speck.mask(cv::Rect(40, 30, 4, 2)).setTo(255);
  EXPECT_THAT(refusal(black), HasSubstr("black"));
  EXPECT_THAT(refusal(saturated), HasSubstr("saturated"));
  EXPECT_THAT(refusal(speck), HasSubstr("mask"));
}

TEST_P(EverySingleImageMethod, StaysFiniteWhereTheImageSaysLittle) {
  LightStack dark_channel = color_lit_bump(), half_clipped = color_lit_bump(), strip = color_lit_bump();
  dark_channel.frames[1].color.setTo(0);  // the green lamp did not light
  for (Frame& frame : half_clipped.frames) frame.color(cv::Rect(0, 0, 48, 72)).setTo(cv::Scalar::all(65535));
  strip.mask.setTo(0);
  strip.mask(cv::Rect(20, 30, 60, 4)).setTo(255);
  for (const LightStack& stack : {dark_channel, half_clipped, strip})
    for (const Preset preset : {Preset::robust, Preset::paper})
      expect_finite(refine_depth(stack, options_of(GetParam(), preset)));
}

TEST_P(EverySingleImageMethod, TakesTheFrameAskedFor) {
  LightStack stack = color_lit_bump();
  for (Light& light : stack.lights)
    light.color = LampColor::rgb;  // else rgb-ratio sees that one lamp was lit
  RefineOptions options = options_of(GetParam());
  options.frame = stack.frames[1].index;
  const RefineResult result = refine_depth(stack, options);
  EXPECT_THAT(result.message, HasSubstr("frame " + std::to_string(options.frame) + " "));
  options.frame = 999;
  EXPECT_THROW(refine_depth(stack, options), UsageError);
}

TEST_P(EverySingleImageMethod, IsRougherWithoutSmoothness) {
  RefineOptions options = options_of(GetParam());
  const RefineResult smooth = refine_depth(color_lit_bump(), options);
  options.depth.smoothness = 0;
  const RefineResult rough = refine_depth(color_lit_bump(), options);
  const auto roughness = [](const RefineResult& result) {
    double sum = 0;
    for (int v = 0; v < result.depth.rows; ++v)
      for (int u = 1; u + 1 < result.depth.cols; ++u) {
        const auto z = [&](int x) { return static_cast<double>(result.depth(v, x)); };
        const double c = z(u - 1) - 2 * z(u) + z(u + 1);
        if (std::isfinite(c)) sum += c * c;
      }
    return sum;
  };
  EXPECT_LT(roughness(smooth), roughness(rough));
}

TEST(SingleImage, TheExposureDoesNotMatter) {
  LightStack stack = color_lit_bump();
  const RefineResult bright = refine_depth(stack, options_of(Method::rgb_ratio));
  for (Frame& frame : stack.frames) frame.color = cv::Mat(frame.color / 4);
  const RefineResult dim = refine_depth(stack, options_of(Method::rgb_ratio));
  double most = 0;
  cv::minMaxLoc(cv::Mat(cv::abs(bright.depth - dim.depth)), nullptr, &most, nullptr, nullptr,
                cv::Mat(bright.depth > 0));
  EXPECT_LT(most, 2e-4);  // metres: only rounding of the images differs
}

TEST(SingleImage, RgbRatioRefusesAnImageUnderOneWhiteLampAndNamesTheMethodThatFits) {
  LightStack stack = test::bump_stack();
  stack.frames.resize(1);
  const std::string message =
      test::message_of<InputError>([&] { refine_depth(stack, options_of(Method::rgb_ratio)); });
  EXPECT_THAT(message, HasSubstr("--method fusion-like"));
  EXPECT_THAT(message, HasSubstr("same side"));
}

TEST(SingleImage, RgbRatioTakesColouredLampsWhetherTheStackNamesThemOrNot) {
  LightStack stack = color_lit_bump();
  cv::Mat channels[3], together;  // blue, green, red in memory
  for (int c = 0; c < 3; ++c)
    cv::extractChannel(stack.frames[static_cast<size_t>(c)].color, channels[2 - c], 2 - c);
  cv::merge(channels, 3, together);
  stack.frames.resize(1);
  stack.frames.front().color = together;
  for (const LampColor color : {LampColor::rgb, LampColor::white}) {
    for (Light& light : stack.lights) light.color = color;
    const RefineResult result = refine_depth(stack, options_of(Method::rgb_ratio));
    EXPECT_GT(result.quality.at("lamp_spread"), 0.1);
    for (const std::string& warning : result.warnings)
      EXPECT_THAT(warning, testing::Not(HasSubstr("same side")));
  }
}

TEST(SingleImage, FusionKeepsTheSensorsDepthWhereItWouldMoveReadingsFarBeyondTheirNoise) {
  LightStack stack = color_lit_bump();
  for (Frame& frame : stack.frames)
    for (int v = 4; v < frame.depth.rows; v += 8)
      for (int u = 4; u < frame.depth.cols; u += 8)
        frame.depth(v, u) = cv::saturate_cast<ushort>(1.03 * frame.depth(v, u));
  const RefineResult result = refine_depth(stack, options_of(Method::fusion_like));
  EXPECT_GT(result.quality.at("beyond_noise_share"), 0.001);
  EXPECT_EQ(cv::countNonZero(cv::Mat(cv::abs(result.depth - result.initial_depth) > 1e-6)), 0);
  EXPECT_THAT(result.warnings, testing::Contains(HasSubstr("one image was not enough")));
  EXPECT_THAT(result.message, HasSubstr("smoothed sensor depth"));
}

TEST(SingleImage, RgbRatioRefusesImagesUnderWhiteLampsOnly) {
  const std::string message =
      test::message_of<InputError>([] { refine_depth(test::bump_stack(), options_of(Method::rgb_ratio)); });
  EXPECT_THAT(message, HasSubstr("multi-light"));
}

}  // namespace
}  // namespace rakelight
