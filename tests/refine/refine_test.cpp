// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/refine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "refine/evaluate.h"
#include "stack/errors.h"
#include "tests/support/bump_stack.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using test::bump_stack;
using test::message_of;
using testing::HasSubstr;

constexpr double kBoundRmse = 0.5;  // mm
constexpr double kBoundMae = 2.0;   // degrees

RefineOptions at_scale(int scale, Preset preset = Preset::robust) {
  RefineOptions options = preset_options(preset);
  options.scale = scale;
  return options;
}

Evaluation before(const RefineResult& result) {
  return evaluate(result.camera, result.initial_depth, {}, test::bump_truth());
}
Evaluation after(const RefineResult& result) {
  return evaluate(result.camera, result.depth, result.normals, test::bump_truth());
}

/// The stack with these of its frames only, in this order.
LightStack with_frames(const std::vector<size_t>& which) {
  LightStack stack = bump_stack();
  const std::vector<Frame> all = std::exchange(stack.frames, {});
  for (const size_t k : which) stack.frames.push_back(all[k]);
  return stack;
}

/// One refinement that several tests look at.
const RefineResult& refined_x2() {
  static const RefineResult result = refine_depth(bump_stack(), at_scale(2));
  return result;
}

TEST(RefineDepth, BringsTheSurfaceNearerToTheTruthAtTheDepthsResolution) {
  const RefineResult result = refine_depth(bump_stack(), at_scale(1));
  EXPECT_EQ(result.scale, 1);
  EXPECT_EQ(result.depth.size(), cv::Size(48, 36));
  EXPECT_LT(after(result).mae_deg, 0.5 * before(result).mae_deg);
}

TEST(RefineDepth, TakesColoursFromTheDiskAsFromMemoryAndShowsEveryFrameSmall) {
  const LightStack stack = bump_stack();
  LightStack left = stack;
  for (Frame& frame : left.frames) {
    frame.read_color = [color = frame.color] { return color.clone(); };
    frame.color = cv::Mat();
  }
  RefineOptions options = at_scale(2);
  options.max_iterations = 2;
  const RefineResult a = refine_depth(stack, options), b = refine_depth(left, options);
  EXPECT_EQ(cv::norm(a.depth, b.depth, cv::NORM_INF), 0);
  ASSERT_EQ(a.thumbnails.size(), stack.frames.size());
  ASSERT_EQ(b.thumbnails.size(), stack.frames.size());
  for (size_t k = 0; k < a.thumbnails.size(); ++k) {
    EXPECT_EQ(a.thumbnails[k].frame, k);
    EXPECT_EQ(cv::norm(a.thumbnails[k].color, b.thumbnails[k].color, cv::NORM_INF), 0);
  }
}

TEST(RefineDepth, BringsTheSurfaceNearerToTheTruthAtTheColoursResolution) {
  const RefineResult& result = refined_x2();
  EXPECT_LT(after(result).mae_deg, kBoundMae);
  EXPECT_LT(after(result).own_normals_mae_deg, kBoundMae);
  EXPECT_LT(after(result).rmse_mm, kBoundRmse);
  EXPECT_LT(after(result).rmse_mm, before(result).rmse_mm);
  EXPECT_LT(after(result).mae_deg, 0.5 * before(result).mae_deg);
}

TEST(RefineDepth, InPresetPaperBringsTheSurfaceNearerToo) {
  const RefineResult result = refine_depth(bump_stack(), at_scale(0, Preset::paper));
  EXPECT_EQ(result.scale, 2);  // as fine as colour is
  EXPECT_LT(after(result).mae_deg, 0.5 * before(result).mae_deg);
  EXPECT_EQ(result.iterations.front().sensor_weight, 100);
}

TEST(RefineDepth, GivesEveryPixelOfTheObjectAndNoOther) {
  const RefineResult& result = refined_x2();
  const cv::Mat1b mask = bump_stack().mask;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const cv::Point at(u, v);
      const bool inside = mask(at) != 0;
      EXPECT_EQ(std::isfinite(result.depth(at)), inside);
      EXPECT_EQ(std::isfinite(result.initial_depth(at)), inside);
      EXPECT_EQ(std::isfinite(result.normals(at)[0]), inside);
      EXPECT_EQ(std::isfinite(result.albedo(at)[2]), inside);
      if (!inside) continue;
      EXPECT_NEAR(cv::norm(result.normals(at)), 1, 1e-5);
      EXPECT_LT(result.normals(at)[2], 0);
    }
  }
}

TEST(RefineDepth, GivesAnAlbedoOfMeanOneThatIsFlatWhereTheObjectsIs) {
  const RefineResult& result = refined_x2();
  cv::Scalar mean, deviation;
  cv::meanStdDev(result.albedo, mean, deviation, bump_stack().mask);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c], 1, 1e-3);
    EXPECT_LT(deviation[c], 0.03);
  }
}

TEST(RefineDepth, GivesEachImagesLight) {
  const RefineResult& result = refined_x2();
  ASSERT_EQ(result.lights.size(), 8U);
  for (size_t i = 0; i < 8; ++i) {
    const LightEstimate& light = result.lights[i];
    EXPECT_EQ(light.id, "lamp-" + std::to_string(i));
    EXPECT_EQ(light.frame_index, static_cast<int>(i));
    const double angle = 2 * CV_PI * static_cast<double>(i) / 8;
    const Eigen::Vector3d truth =
        Eigen::Vector3d(0.6 * std::cos(angle), 0.6 * std::sin(angle), -1).normalized();
    const Eigen::Vector3d found = light.sh_rgb.row(0).head<3>().transpose().normalized();
    EXPECT_GT(found.dot(truth), std::cos(8 * CV_PI / 180)) << light.id;
  }
}

TEST(RefineDepth, RefusesHarmonicsThatItDoesNotKnow) {
  RefineOptions options = at_scale(1);
  options.lamps.harmonics = 3;
  EXPECT_THROW(refine_depth(bump_stack(), options), UsageError);
  options.lamps.harmonics = 2;
  options.lamps.model = LampModel::near;
  EXPECT_THAT(message_of<UsageError>([&] { refine_depth(bump_stack(), options); }), HasSubstr("far lamps"));
}

TEST(RefineDepth, SaysHowItEndedAndWhatItMeasured) {
  const RefineResult& result = refined_x2();
  EXPECT_NE(result.termination, Termination::diverged);
  EXPECT_THAT(result.message, HasSubstr("iterations"));
  EXPECT_EQ(result.iterations.back().index, static_cast<int>(result.iterations.size()));
  EXPECT_GT(result.quality.at("depth_noise_m"), 0.3 * 0.001);  // eight frames of 1 mm, and some curvature
  EXPECT_EQ(result.quality.at("coverage"), 1);
  EXPECT_GT(result.quality.at("lamp_spread"), 0.2);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(RefineDepth, TheEnergyDoesNotRiseInAnyDepthStep) {
  for (const IterationReport& report : refined_x2().iterations) {
    EXPECT_LE(report.energy, report.energy_before_depth) << "iteration " << report.index;
    EXPECT_GT(report.sensor_weight, 0);
  }
}

bool same_bytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         std::memcmp(a.data, b.data, a.total() * a.elemSize()) == 0;
}

TEST(RefineDepth, TheResultDoesNotDependOnTheNumberOfThreads) {
  for (const bool weighted : {true, false}) {
    RefineOptions options = at_scale(2);
    options.max_iterations = 12;
    if (!weighted) options.trust.cauchy_scale = 0;
    options.threads = 1;
    const RefineResult one = refine_depth(bump_stack(), options);
    options.threads = 2;
    const RefineResult two = refine_depth(bump_stack(), options);
    EXPECT_TRUE(same_bytes(one.depth, two.depth)) << weighted;
    EXPECT_TRUE(same_bytes(one.normals, two.normals)) << weighted;
    EXPECT_TRUE(same_bytes(one.albedo, two.albedo)) << weighted;
  }
}

TEST(RefineDepth, ReportsProgressThatOnlyGrows) {
  double last = -1;
  int iteration = 0;
  RefineOptions options = at_scale(1);
  options.max_iterations = 5;
  refine_depth(bump_stack(), options, [&](const Progress& progress) {
    EXPECT_GE(progress.fraction_done, last);
    EXPECT_LE(progress.fraction_done, 1);
    EXPECT_FALSE(progress.stage.empty());
    last = progress.fraction_done;
    iteration = progress.iteration;
    return true;
  });
  EXPECT_EQ(iteration, 5);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(RefineDepth, ShowsTheSurfaceOnItsWayToTheResult) {
  std::vector<SurfaceSoFar> surfaces;
  const RefineResult result = refine_depth(bump_stack(), at_scale(2), [&](const Progress& progress) {
    if (progress.surface) surfaces.push_back(progress.surface());
    return true;
  });
  ASSERT_EQ(surfaces.size(), result.iterations.size());
  const auto distance = [&](const SurfaceSoFar& surface) {
    cv::Mat1f difference = cv::Mat(cv::abs(surface.depth - result.depth));
    cv::patchNaNs(difference, 0);
    return cv::norm(difference, cv::NORM_INF);
  };
  EXPECT_EQ(surfaces.front().camera.size(), result.camera.size());
  EXPECT_GT(distance(surfaces.front()), 1e-5);
  EXPECT_LT(distance(surfaces.back()), 1e-6);
}

TEST(RefineDepth, StopsWhenItsCallerSaysSo) {
  EXPECT_THROW(refine_depth(bump_stack(), at_scale(1), [](const Progress&) { return false; }), Cancelled);
  int last = 0;
  const auto until_third = [&](const Progress& progress) { return (last = progress.iteration) < 3; };
  EXPECT_THROW(refine_depth(bump_stack(), at_scale(1), until_third), Cancelled);
  EXPECT_EQ(last, 3);
}

TEST(RefineDepth, StopsAtTheIterationLimitAndSaysSo) {
  RefineOptions options = at_scale(1);
  options.max_iterations = 2;
  const RefineResult result = refine_depth(bump_stack(), options);
  EXPECT_EQ(result.iterations.size(), 2U);
  EXPECT_EQ(result.termination, Termination::max_iterations);
  EXPECT_THAT(result.message, HasSubstr("limit"));
}

TEST(RefineDepth, FlagsWhatTheSensorDidNotSeeAndFillsIt) {
  LightStack stack = bump_stack();
  const cv::Rect hole(20, 12, 5, 4);  // depth pixels
  for (Frame& frame : stack.frames) frame.depth(hole).setTo(0);
  const RefineResult result = refine_depth(stack, at_scale(2));
  EXPECT_EQ(cv::countNonZero(result.inpainted), 4 * hole.area());
  EXPECT_EQ(cv::countNonZero(result.inpainted(cv::Rect(40, 24, 10, 8))), 4 * hole.area());
  EXPECT_LT(result.quality.at("coverage"), 1);
  EXPECT_LT(after(result).mae_deg, kBoundMae);
}

TEST(RefineDepth, TakesAMaskOnTheDepthsGridOrNone) {
  LightStack stack = bump_stack();
  stack.mask = cv::Mat1b(stack.depth_camera.size(), uchar{0});
  stack.mask(cv::Rect(5, 5, 30, 20)).setTo(255);
  RefineOptions options = at_scale(2);
  options.max_iterations = 3;
  EXPECT_EQ(cv::countNonZero(refine_depth(stack, options).depth > 0), 4 * 30 * 20);
  stack.mask.release();
  EXPECT_EQ(cv::countNonZero(refine_depth(stack, options).depth > 0), 96 * 72);
}

TEST(RefineDepth, SubtractsTheDarkFrame) {
  LightStack stack = bump_stack();
  Frame dark;
  dark.index = 8;
  dark.color = cv::Mat(stack.color_camera.size(), CV_16UC3, cv::Scalar(3000, 1000, 2000));
  for (Frame& frame : stack.frames) frame.color += dark.color;
  stack.frames.push_back(dark);
  RefineOptions options = at_scale(1);
  options.max_iterations = 3;
  const RefineResult lit = refine_depth(stack, options), plain = refine_depth(bump_stack(), options);
  EXPECT_EQ(lit.lights.size(), 8U);
  EXPECT_LT(cv::norm(lit.depth(cv::Rect(5, 5, 30, 20)), plain.depth(cv::Rect(5, 5, 30, 20)), cv::NORM_INF),
            1e-5);
}

TEST(RefineDepth, RefusesAScaleFinerThanTheColour) {
  EXPECT_THAT(message_of<UsageError>([] { refine_depth(bump_stack(), at_scale(3)); }),
              HasSubstr("2 times as fine"));
}

TEST(RefineDepth, RefusesFewerThanFourImages) {
  EXPECT_THAT(message_of<InputError>([] {
                refine_depth(with_frames({0, 2, 5}), at_scale(1));
              }),
              HasSubstr("at least 4"));
}

TEST(RefineDepth, RefusesLampsThatDoNotDetermineTheShape) {
  EXPECT_THAT(message_of<InputError>([] {
                refine_depth(with_frames({1, 1, 1, 1}), at_scale(1));
              }),
              HasSubstr("all from one"));
  EXPECT_THAT(message_of<InputError>([] {
                refine_depth(with_frames({0, 4, 0, 4}), at_scale(1));
              }),
              HasSubstr("in one plane"));
}

TEST(RefineDepth, RefusesImagesThatShowNothing) {
  LightStack stack = bump_stack();
  for (Frame& frame : stack.frames) frame.color.setTo(0);
  EXPECT_THAT(message_of<InputError>([&] { refine_depth(stack, {}); }), HasSubstr("black"));
  for (Frame& frame : stack.frames) frame.color.setTo(cv::Scalar::all(65535));
  EXPECT_THAT(message_of<InputError>([&] { refine_depth(stack, {}); }), HasSubstr("saturated"));
}

TEST(RefineDepth, RefusesAMaskOfOnePixelOrNone) {
  LightStack stack = bump_stack();
  stack.mask.setTo(0);
  EXPECT_THAT(message_of<InputError>([&] { refine_depth(stack, {}); }), HasSubstr("mask"));
  stack.mask(30, 40) = 255;
  EXPECT_THAT(message_of<InputError>([&] { refine_depth(stack, {}); }), HasSubstr("mask"));
}

TEST(RefineDepth, RefusesDepthWithoutAReading) {
  LightStack stack = bump_stack();
  for (Frame& frame : stack.frames) frame.depth.setTo(0);
  EXPECT_THAT(message_of<InputError>([&] { refine_depth(stack, {}); }), HasSubstr("depth"));
}

TEST(RefineDepth, SurvivesMasksOfManyPiecesAndThinLines) {
  LightStack stack = bump_stack();
  stack.mask.setTo(0);
  for (int v = 4; v < 70; v += 9) stack.mask.row(v).setTo(255);
  for (int u = 4; u < 90; u += 20) stack.mask(cv::Rect(u, 20, 7, 9)).setTo(255);
  RefineOptions options = at_scale(2);
  options.max_iterations = 4;
  const RefineResult result = refine_depth(stack, options);
  EXPECT_EQ(cv::countNonZero(result.depth > 0), cv::countNonZero(stack.mask));
}

/// In the dark a share of the radiance is less than rounding: weights by so small a scale would leave no sample.
TEST(RefineDepth, DoesNotTakeMatchesOfDarkSamplesForExact) {
  LightStack stack = bump_stack();
  for (Frame& frame : stack.frames) frame.color = frame.color / 100;
  const RefineResult result = refine_depth(stack, at_scale(1));
  for (const IterationReport& iteration : result.iterations) EXPECT_GE(iteration.residual_scale, 1e-3);
}

TEST(RefineDepth, SurvivesImagesOfWhichSomeAreBlackOrSaturated) {
  LightStack stack = bump_stack();
  stack.frames[2].color.setTo(0);
  stack.frames[5].color.setTo(cv::Scalar::all(65535));
  const RefineResult result = refine_depth(stack, at_scale(2));
  EXPECT_EQ(cv::countNonZero(result.depth > 0), cv::countNonZero(stack.mask));
  EXPECT_LT(after(result).mae_deg, 0.5 * before(result).mae_deg);
}

}  // namespace
}  // namespace rakelight
