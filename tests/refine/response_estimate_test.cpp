// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simulator's response against the one that is found. The manifest is overridden: it must not decide.
#include "refine/response_estimate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "refine/refine.h"
#include "simulate/simulate.h"
#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

/// A vase of 160 x 120, eight lamps, in images as real as the simulator makes them.
LightStack scan(const ColorResponse& response, const ColorResponse& stated, double crosstalk = 0,
                int bits = 8) {
  SimulateOptions options = realism_options(Realism::real);
  options.width = 160;
  options.height = 120;
  options.lamps.count = 8;
  options.image.samples = 2;
  options.image.response = response;
  options.image.crosstalk = crosstalk;
  options.image.bits = bits;
  LightStack stack = simulate_stack(options).stack;
  stack.color_response = stated;
  return stack;
}

const ColorResponse kLinear{};
ColorResponse exponent(double gamma) { return {ColorResponse::Kind::gamma, gamma}; }

TEST(ResponseEstimate, FindsTheExponentWhateverTheStackStates) {
  for (const double gamma : {1.0, 1.8, 2.6}) {
    const ColorResponse stated = gamma == 1.0 ? exponent(2.2) : kLinear;
    const ResponseEstimate estimate = estimate_response(scan(exponent(gamma), stated), {});
    EXPECT_TRUE(estimate.sure) << gamma << ": " << estimate.message;
    EXPECT_NEAR(estimate.gamma / gamma, 1, 0.16) << estimate.message;
    EXPECT_LT(std::abs(estimate.gamma - gamma), 2.5 * estimate.deviation) << estimate.message;
    EXPECT_THAT(estimate.message, HasSubstr("used instead of the stack's " + to_string(stated)));
    EXPECT_EQ(estimate.used.kind, ColorResponse::Kind::gamma);
    EXPECT_EQ(estimate.used.gamma, estimate.gamma);
  }
}

TEST(ResponseEstimate, KeepsWhatTheStackStatesWhereTheImagesAgree) {
  const ResponseEstimate estimate =
      estimate_response(scan(exponent(2.2), {ColorResponse::Kind::srgb, 1}), {});
  EXPECT_EQ(estimate.used.kind, ColorResponse::Kind::srgb);
  EXPECT_THAT(estimate.message, HasSubstr("agrees, the stack's srgb is kept"));
}

TEST(ResponseEstimate, UndoesCrosstalkAfterDecoding) {
  const ResponseEstimate estimate = estimate_response(scan(exponent(1.8), kLinear, 0.2, 16), {});
  EXPECT_TRUE(estimate.sure) << estimate.message;
  EXPECT_NEAR(estimate.gamma / 1.8, 1, 0.16) << estimate.message;
}

TEST(ResponseEstimate, SaysThatFewImagesDoNotTell) {
  LightStack stack = scan(exponent(2.2), kLinear);
  stack.frames.resize(1 + 5);  // the dark frame and five lit ones
  const ResponseEstimate estimate = estimate_response(stack, {});
  EXPECT_FALSE(estimate.sure);
  EXPECT_EQ(estimate.used.kind, ColorResponse::Kind::linear);
  EXPECT_THAT(estimate.message, HasSubstr("not sure (it takes 6 images"));
}

TEST(ResponseEstimate, SaysThatAPlaneDoesNotTell) {
  SimulateOptions options = realism_options(Realism::real);
  options.width = 80;
  options.height = 60;
  options.lamps.count = 8;
  options.image.samples = 1;
  options.scene.kind = SceneKind::plane;
  options.image.response = exponent(2.2);
  LightStack stack = simulate_stack(options).stack;
  stack.color_response = kLinear;
  const ResponseEstimate estimate = estimate_response(stack, {});
  EXPECT_FALSE(estimate.sure) << estimate.message;
  EXPECT_EQ(estimate.used.kind, ColorResponse::Kind::linear);
  EXPECT_THAT(estimate.message, HasSubstr("not sure ("));
}

TEST(ResponseEstimate, CanBeCancelled) {
  EXPECT_THROW(estimate_response(scan(kLinear, kLinear), {}, [](double) { return false; }), Cancelled);
}

TEST(RefineDepth, UsesAndReportsTheResponseItFinds) {
  RefineOptions options = preset_options(Preset::robust);
  options.estimate_response = true;
  options.max_iterations = 3;
  const RefineResult result = refine_depth(scan(exponent(2.2), kLinear), options);
  ASSERT_TRUE(result.response_estimate.has_value());
  EXPECT_EQ(result.color_response.gamma, result.response_estimate->gamma);
  EXPECT_THAT(result.message, HasSubstr("response: gamma"));
  options.estimate_response = false;
  const RefineResult plain = refine_depth(scan(exponent(2.2), kLinear), options);
  EXPECT_FALSE(plain.response_estimate.has_value());
  EXPECT_EQ(plain.color_response.kind, ColorResponse::Kind::linear);
}

}  // namespace
}  // namespace rakelight
