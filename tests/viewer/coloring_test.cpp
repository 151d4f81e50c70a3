// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/coloring.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

TEST(Coloring, DeltaIsMillimetresDeeperThanTheStart) {
  const Scene scene = test::bump_scene();
  const cv::Mat1f delta = values_of(scene, *scene.find(LayerKind::refined), Coloring::delta);
  EXPECT_NEAR(delta(60, 80), -20, 0.1);  // the bump is 20 mm nearer
  EXPECT_NEAR(delta(0, 0), 0, 0.1);
  EXPECT_EQ(range_of(scene, Coloring::delta)->unit, "mm");
}

TEST(Coloring, ErrorIsTakenOnAFinerTruth) {
  Scene scene = test::bump_scene();
  Layer truth = *scene.find(LayerKind::preprocessed);
  truth.kind = LayerKind::truth;
  cv::resize(truth.depth, truth.depth, {}, 2, 2, cv::INTER_NEAREST);
  scene.layers.push_back(truth);
  const cv::Mat1f error = values_of(scene, *scene.find(LayerKind::refined), Coloring::error);
  EXPECT_NEAR(error(60, 80), -20, 0.1);
}

TEST(Coloring, OneScaleBarServesBothSidesOfTheDivider) {
  const Scene scene = test::bump_scene();
  const auto range = range_of(scene, Coloring::delta);
  const Layer &before = *scene.find(LayerKind::preprocessed), &after = *scene.find(LayerKind::refined);
  const auto left = colors_of(scene, before, surface_of(before, ""), Coloring::delta, 0, range);
  const auto right = colors_of(scene, after, surface_of(after, ""), Coloring::delta, 0, range);
  EXPECT_EQ(left[60 * 160 + 80], cv::Vec3b(247, 247, 247));
  EXPECT_EQ(right[60 * 160 + 80], color_of(*range, range->low));
}

TEST(Coloring, AnImageOfAnotherSizeCoversTheSameView) {
  Scene scene = test::bump_scene();
  cv::Mat3b picture(240, 320, cv::Vec3b(10, 20, 30));
  picture(cv::Rect(0, 0, 160, 240)) = cv::Vec3b(200, 0, 0);
  scene.frames.push_back({"lamp", picture});
  const Layer& layer = *scene.find(LayerKind::refined);
  const auto colors = colors_of(scene, layer, surface_of(layer, ""), Coloring::image, 0, {});
  EXPECT_EQ(colors[79], cv::Vec3b(200, 0, 0));
  EXPECT_EQ(colors[80], cv::Vec3b(10, 20, 30));
}

TEST(Coloring, NormalsArePaintedAsOpenGlToolsDo) {
  Scene scene = test::bump_scene();
  const Layer& layer = *scene.find(LayerKind::preprocessed);
  const auto colors = colors_of(scene, layer, surface_of(layer, ""), Coloring::normals, 0, {});
  EXPECT_EQ(colors[60 * 160 + 80], cv::Vec3b(128, 128, 255));
}

TEST(Coloring, SaysWhatIsMissing) {
  const Scene scene = test::bump_scene();
  EXPECT_EQ(obstacle(scene, Coloring::albedo), "");
  EXPECT_THAT(obstacle(scene, Coloring::image), HasSubstr("--stack"));
  EXPECT_THAT(obstacle(scene, Coloring::error), HasSubstr("truth"));
}

}  // namespace
}  // namespace rakelight
