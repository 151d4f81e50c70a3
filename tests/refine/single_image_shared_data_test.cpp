// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One image under red, green and blue lamps: the errors that the single-image methods' defaults must keep to.
#include <gtest/gtest.h>

#include <iostream>

#include "refine/evaluate.h"
#include "refine/refine.h"
#include "stack/stack_io.h"
#include "tests/support/shared_data.h"

namespace rakelight {
namespace {

void expect_errors_at_most(const std::filesystem::path& folder, Method method, double rmse_mm,
                           double mae_deg) {
  const RefineResult result = refine_depth(read_stack(folder), preset_options(Preset::robust, method));
  const GroundTruth truth = read_truth(folder);
  const Evaluation before = evaluate(result.camera, result.initial_depth, {}, truth);
  const Evaluation after = evaluate(result.camera, result.depth, result.normals, truth);
  EXPECT_LE(after.rmse_mm, std::min(rmse_mm, before.rmse_mm));
  EXPECT_LE(after.mae_deg, std::min(mae_deg, before.mae_deg));
  std::cout << folder.filename().string() << ", " << to_string(method) << ": " << after.rmse_mm << " mm, "
            << after.mae_deg << " deg; " << result.message << "\n";
}

TEST(SharedDataSingleImage, RgbRatioOnIgeaSimple) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-simple-led");
  expect_errors_at_most(folder, Method::rgb_ratio, 1.8, 2.8);
}

TEST(SharedDataSingleImage, RgbRatioOnIgeaPattern) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-pattern-led");
  expect_errors_at_most(folder, Method::rgb_ratio, 2.2, 5.0);
}

TEST(SharedDataSingleImage, RgbRatioOnIgeaComplicated) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-complicated-led");
  expect_errors_at_most(folder, Method::rgb_ratio, 3.0, 13.0);
}

TEST(SharedDataSingleImage, FusionLikeOnIgeaSimple) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-simple-led");
  expect_errors_at_most(folder, Method::fusion_like, 3.3, 15.4);
}

TEST(SharedDataSingleImage, RgbdFusionOnIgeaPattern) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-pattern-led");
  expect_errors_at_most(folder, Method::rgbd_fusion, 3.3, 15.4);
}

TEST(SharedDataSingleImage, FusionLikeOnIgeaComplicated) {
  RAKELIGHT_NEED_SHARED_DATA(folder, "table2/igea-complicated-led");
  expect_errors_at_most(folder, Method::fusion_like, 3.3, 15.4);
}

}  // namespace
}  // namespace rakelight
