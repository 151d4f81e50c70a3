// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

const Scene kScene = test::bump_scene();
const Eigen::Vector3d kLeft(-0.15, 0, 0.5), kRight(0.15, 0, 0.5);  // on the plane, the bump between them

double highest(const std::vector<ProfilePoint>& profile) {
  double height = -1e9;
  for (const ProfilePoint& p : profile) height = std::max(height, p.height_mm);
  return height;
}

TEST(Profile, OfThePlaneIsStraightAndAsLongAsTheLine) {
  const auto profile = profile_of(*kScene.find(LayerKind::preprocessed), kLeft, kRight);
  EXPECT_NEAR(highest(profile), 0, 1e-3);
  EXPECT_NEAR(profile.front().along_mm, 0, 1e-3);
  EXPECT_NEAR(profile.back().along_mm, 300, 1e-3);
}

TEST(Profile, OfTheBumpRisesTowardsTheCamera) {
  EXPECT_NEAR(highest(profile_of(*kScene.find(LayerKind::refined), kLeft, kRight)), 20, 0.2);
}

TEST(Profile, HasGapsWhereThereIsNoSurface) {
  Layer layer = *kScene.find(LayerKind::preprocessed);
  layer.depth = layer.depth.clone();
  layer.depth(cv::Rect(70, 50, 20, 20)) = std::nanf("");
  const auto profile = profile_of(layer, kLeft, kRight);
  EXPECT_TRUE(std::isnan(profile[profile.size() / 2].height_mm));
  EXPECT_FALSE(std::isnan(profile.front().height_mm));
}

TEST(Profile, OfOnePointIsEmpty) {
  EXPECT_TRUE(profile_of(*kScene.find(LayerKind::refined), kLeft, kLeft).empty());
}

}  // namespace
}  // namespace rakelight
