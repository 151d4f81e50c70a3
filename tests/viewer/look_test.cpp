// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/look.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stack/errors.h"
#include "tests/viewer/bump_result.h"
#include "viewer/viewer.h"

namespace rakelight {
namespace {

TEST(Look, LightAnglesAreAsSeenInThePicture) {
  const auto right = light_direction({0, 0}), above = light_direction({90, 0}),
             viewer = light_direction({17, 90});
  EXPECT_NEAR(right[0], 1, 1e-6);
  EXPECT_NEAR(above[1], 1, 1e-6);
  EXPECT_NEAR(viewer[2], 1, 1e-6);
}

TEST(Look, TheMouseAtTheEdgeGrazesAndInTheMiddleIsStraight) {
  EXPECT_NEAR(light_at(0, 0).elevation_deg, 90, 1e-9);
  EXPECT_LT(light_at(0, 0.98).elevation_deg, 5);
  EXPECT_NEAR(light_at(0, 0.98).azimuth_deg, 90, 1e-9);
  EXPECT_GT(light_at(3, 3).elevation_deg, 0);
}

TEST(Look, NamesAndValuesAreOneToOne) {
  for (const auto& [value, name] : kColoringNames) {
    EXPECT_EQ(name_of(kColoringNames, value), name);
    EXPECT_EQ(value_of(kColoringNames, name), value);
  }
  EXPECT_FALSE(value_of(kColoringNames, "pink").has_value());
}

TEST(Look, OfAResultShowsTheRefinedSurfaceOfAScanPointsInItsBrightestImage) {
  Scene scene = test::bump_scene();
  EXPECT_EQ(default_look(scene).layer, LayerKind::refined);
  EXPECT_FALSE(default_look(scene).points);
  scene.layers.resize(1);
  scene.layers[0].kind = LayerKind::sensor;
  scene.frames = {{"dim", cv::Mat3b(2, 2, cv::Vec3b(9, 9, 9))},
                  {"bright", cv::Mat3b(2, 2, cv::Vec3b(90, 9, 9))}};
  EXPECT_TRUE(default_look(scene).points);
  EXPECT_EQ(default_look(scene).image, 1);
}

TEST(Look, ThatAsksForWhatIsNotThereIsRefused) {
  Look look;
  look.layer = LayerKind::truth;
  EXPECT_THROW(check_look(test::bump_scene(), look), UsageError);
  look = {};
  look.coloring = Coloring::image;
  EXPECT_THROW(check_look(test::bump_scene(), look), UsageError);
}

}  // namespace
}  // namespace rakelight
