// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/color_calibration.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "stack/color_response.h"
#include "stack/errors.h"
#include "tests/support/message_of.h"

namespace rakelight::test {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 160, kHeight = 120;

Eigen::Matrix3d leaky() {
  Eigen::Matrix3d crosstalk;
  crosstalk << 1, 0.12, 0.01, 0.07, 1, 0.15, 0.004, 0.09, 1;
  return crosstalk;
}

/// A card lit from one side, a dark rim around it; 8 bits with noise.
cv::Mat picture(const Eigen::Vector3d& light, const Eigen::Vector3d& ambient, const ColorResponse& response,
                unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.004);
  cv::Mat3b image(kHeight, kWidth);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const bool rim = u < 10 || v < 10;
      const double shade = rim ? 0.02 : 0.5 + 0.5 * u / kWidth;
      for (int c = 0; c < 3; ++c) {
        const double radiance = std::clamp(shade * (light[c] + ambient[c]) + noise(random), 0.0, 1.0);
        image(v, u)[c] = cv::saturate_cast<uchar>(255 * encode(response, radiance));
      }
    }
  }
  return image;
}

/// Red, green and blue lamps one by one, and a dark frame.
LightStack card_stack(const Eigen::Matrix3d& crosstalk, const ColorResponse& response) {
  LightStack stack;
  stack.origin = "card";
  stack.color_response = response;
  const Eigen::Vector3d ambient(0.03, 0.03, 0.02), strength(0.7, 0.55, 0.6);
  stack.lights = {
      {"r", LampColor::red, {}, {}}, {"g", LampColor::green, {}, {}}, {"b", LampColor::blue, {}, {}}};
  for (int k = -1; k < 3; ++k) {
    Frame frame;
    frame.index = k + 1;
    if (k >= 0) frame.light = stack.lights[static_cast<std::size_t>(k)].id;
    const Eigen::Vector3d light =
        k < 0 ? Eigen::Vector3d::Zero().eval() : (crosstalk.col(k) * strength[k]).eval();
    frame.color = picture(light, ambient, response, static_cast<unsigned>(k + 2));
    stack.frames.push_back(frame);
  }
  return stack;
}

TEST(Crosstalk, IsWhatTheCardShowsWhateverTheLampsStrengths) {
  for (const ColorResponse response : {ColorResponse{}, ColorResponse{ColorResponse::Kind::srgb, 1}}) {
    const CrosstalkFit fit = measure_crosstalk(card_stack(leaky(), response));
    EXPECT_LT((fit.crosstalk - leaky()).cwiseAbs().maxCoeff(), 0.004) << fit.crosstalk;
    EXPECT_EQ(fit.crosstalk(1, 1), 1);
    EXPECT_LT(fit.deviation.maxCoeff(), 0.01);
  }
}

TEST(Crosstalk, IgnoresWhatTheStackAlreadySays) {
  LightStack stack = card_stack(leaky(), {});
  stack.color_crosstalk = leaky();
  EXPECT_LT((measure_crosstalk(stack).crosstalk - leaky()).cwiseAbs().maxCoeff(), 0.004);
}

TEST(Crosstalk, RefusesAMissingColorAndSwappedLamps) {
  LightStack stack = card_stack(leaky(), {});
  stack.frames.pop_back();
  EXPECT_THAT(message_of<InputError>([&] { measure_crosstalk(stack); }),
              HasSubstr("too little unclipped light of a blue"));
  LightStack swapped = card_stack(leaky(), {});
  std::swap(swapped.lights[0].color, swapped.lights[1].color);
  EXPECT_THAT(message_of<InputError>([&] { measure_crosstalk(swapped); }), HasSubstr("more than its own"));
}

/// One scene at several exposures.
std::vector<LightStack> sweep(const ColorResponse& response, const std::vector<double>& exposures_us) {
  std::vector<LightStack> stacks;
  for (const double exposure : exposures_us) {
    LightStack stack;
    stack.origin = "sweep";
    stack.exposure_us = exposure;
    stack.gain = 1;
    stack.lights = {{"w", LampColor::white, {}, {}}};
    Frame frame;
    frame.light = "w";
    const Eigen::Vector3d light = Eigen::Vector3d(0.9, 1.0, 0.8) * (exposure / 20000);
    frame.color = picture(light, Eigen::Vector3d::Zero(), response, static_cast<unsigned>(exposure));
    stack.frames = {frame};
    stacks.push_back(stack);
  }
  return stacks;
}

const std::vector<double> kExposures{2500, 5000, 10000, 20000};

TEST(Response, ExponentIsFoundFromAnExposureSweep) {
  for (const double gamma : {1.6, 2.2}) {
    const ResponseFit fit = measure_response(sweep({ColorResponse::Kind::gamma, gamma}, kExposures));
    EXPECT_NEAR(fit.gamma, gamma, 0.03);
    EXPECT_LT(fit.deviation, 0.06);
    EXPECT_EQ(fit.response.kind, ColorResponse::Kind::gamma) << gamma;
  }
}

TEST(Response, NamedCurvesAreToldApart) {
  EXPECT_EQ(measure_response(sweep({}, kExposures)).response.kind, ColorResponse::Kind::linear);
  EXPECT_EQ(measure_response(sweep({ColorResponse::Kind::srgb, 1}, kExposures)).response.kind,
            ColorResponse::Kind::srgb);
}

TEST(Response, RefusesASweepThatTellsNothing) {
  EXPECT_THAT(message_of<InputError>([] {
                measure_response(sweep({}, {8000, 9000}));
              }),
              HasSubstr("do not differ enough"));
  auto untold = sweep({}, kExposures);
  untold[2].exposure_us.reset();
  EXPECT_THAT(message_of<InputError>([&] { measure_response(untold); }),
              HasSubstr("does not tell its exposure"));
  auto brighter = sweep({}, kExposures);
  brighter[1].gain = 2;
  EXPECT_THAT(message_of<InputError>([&] { measure_response(brighter); }), HasSubstr("another gain"));
}

}  // namespace
}  // namespace rakelight::test
