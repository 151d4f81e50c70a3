// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Recorded and rendered stacks with a truth: the errors that the default parameters must keep to. One set of parameters
// for all; each stack is refined once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

#include "refine/evaluate.h"
#include "refine/refine.h"
#include "stack/stack_io.h"
#include "tests/support/shared_data.h"

namespace rakelight {
namespace {

/// Refines `folder` as fine as its colour allows and holds the result against the folder's truth.
RefineResult expect_errors_at_most(const std::filesystem::path& folder, Preset preset, double rmse_mm,
                                   double mae_deg) {
  RefineResult result = refine_depth(read_stack(folder), preset_options(preset));
  const Evaluation found = evaluate(result.camera, result.depth, result.normals, read_truth(folder));
  EXPECT_LE(found.rmse_mm, rmse_mm);
  EXPECT_LE(found.mae_deg, mae_deg);
  std::cout << folder.filename().string() << ", " << to_string(preset) << ": " << found.rmse_mm << " mm, "
            << found.mae_deg << " deg; " << result.message << "\n";
  return result;
}

TEST(SharedData, IgeaSimpleInPresetPaper) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-simple-sh1");
  expect_errors_at_most(folder, Preset::paper, 2.75, 2.25);
}

TEST(SharedData, IgeaPatternInPresetPaper) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-pattern-sh1");
  expect_errors_at_most(folder, Preset::paper, 2.45, 2.10);
}

TEST(SharedData, IgeaComplicatedInPresetPaper) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-complicated-sh1");
  expect_errors_at_most(folder, Preset::paper, 2.65, 2.40);
}

TEST(SharedData, IgeaSimple) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-simple-sh1");
  expect_errors_at_most(folder, Preset::robust, 1.35, 1.25);
}

TEST(SharedData, IgeaPattern) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-pattern-sh1");
  expect_errors_at_most(folder, Preset::robust, 1.35, 1.25);
}

TEST(SharedData, IgeaComplicated) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-complicated-sh1");
  expect_errors_at_most(folder, Preset::robust, 1.35, 1.25);
}

TEST(SharedData, IgeaPatternWithShadowsAndHighlights) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-pattern-real");
  expect_errors_at_most(folder, Preset::robust, 1.6, 2.3);
}

TEST(SharedData, IgeaComplicatedWithShadowsAndHighlights) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-complicated-real");
  expect_errors_at_most(folder, Preset::robust, 1.6, 2.4);
}

TEST(SharedData, IgeaPatternUnderNearLamps) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-pattern-near");
  const RefineResult result = expect_errors_at_most(folder, Preset::robust, 1.8, 2.7);
  for (const LightEstimate& light : result.lights) EXPECT_TRUE(light.position_m.has_value()) << light.id;
}

TEST(SharedData, PhotographsOfABear) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "bear-x1");
  expect_errors_at_most(folder, Preset::robust, 0.39, 4.2);
}

TEST(SharedData, PhotographsOfABearAtTwiceTheDepthsResolution) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "bear-x2");
  EXPECT_EQ(expect_errors_at_most(folder, Preset::robust, 0.60, 5.0).scale, 2);
}

TEST(SharedData, ARecordedMittenIsRefinedUnderNearLamps) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "mitten");
  const LightStack stack = read_stack(folder);
  const RefineResult result = refine_depth(stack, {});
  EXPECT_EQ(result.scale, 2);
  EXPECT_THAT(result.message, testing::HasSubstr("near lamps"));
  EXPECT_EQ(cv::countNonZero(result.depth > 0), cv::countNonZero(stack.mask >= 128));
  double nearest = 0, farthest = 0;
  cv::minMaxLoc(result.depth, &nearest, &farthest, nullptr, nullptr, result.depth > 0);
  EXPECT_GT(nearest, 0.1);
  EXPECT_LT(farthest, 5);
}

}  // namespace
}  // namespace rakelight
