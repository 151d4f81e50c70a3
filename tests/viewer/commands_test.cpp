// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/viewer/bump_result.h"

namespace rakelight {
namespace {

using testing::HasSubstr;

class Commands : public testing::Test {
 protected:
  const Scene scene_ = test::bump_scene();
  ViewState state_;
  void press(const std::string& key) { EXPECT_TRUE(press_key(key, state_, scene_)) << key; }
};

TEST_F(Commands, EachKeyHasOneMeaning) {
  std::set<std::string> keys;
  for (const KeyCommand& command : key_commands())
    EXPECT_TRUE(keys.insert(command.key).second) << command.key;
  EXPECT_FALSE(press_key("Z", state_, scene_));
}

TEST_F(Commands, NumbersChooseTheLayer) {
  press("2");
  EXPECT_EQ(state_.look.layer, LayerKind::preprocessed);
  press("3");
  EXPECT_EQ(state_.look.layer, LayerKind::refined);
}

TEST_F(Commands, ALayerThatIsNotThereIsExplained) {
  press("1");
  EXPECT_EQ(state_.look.layer, LayerKind::refined);
  EXPECT_THAT(state_.status, HasSubstr("--stack"));
}

TEST_F(Commands, SteppingThroughColouringsSkipsWhatTheSceneLacks) {
  std::set<Coloring> seen;
  for (int i = 0; i < 8; ++i) {
    press("C");
    seen.insert(state_.look.coloring);
  }
  EXPECT_EQ(seen.count(Coloring::image) + seen.count(Coloring::error), 0u);
  EXPECT_EQ(seen.size(), 6u);
  const Coloring now = state_.look.coloring;
  press("C");
  press("V");
  EXPECT_EQ(state_.look.coloring, now);
}

TEST_F(Commands, TheImageKeysNeedImages) {
  press("]");
  EXPECT_NE(state_.look.coloring, Coloring::image);
  Scene scene = scene_;
  scene.frames.resize(3, {"lamp", cv::Mat3b(2, 2)});
  press_key("[", state_, scene);
  EXPECT_EQ(state_.look.coloring, Coloring::image);
  EXPECT_EQ(state_.look.image, 2);
}

TEST_F(Commands, StandardViewsFitTheObject) {
  state_.bounds = {{-1, -1, 1}, {1, 1, 2}};
  press("F5");
  EXPECT_NEAR(state_.camera.target.z(), 1.5, 1e-12);
  EXPECT_GT(state_.camera.azimuth, 1.5);
}

TEST_F(Commands, MeasuresBetweenTwoPointsAndStartsAnewAtTheThird) {
  add_point(state_, {0, 0, 1});
  EXPECT_TRUE(state_.points.empty()) << "without a tool";
  press("D");
  add_point(state_, {0, 0, 1});
  add_point(state_, {0.03, 0.04, 1});
  EXPECT_NEAR(measured_mm(state_), 50, 1e-9);
  add_point(state_, {0, 0, 2});
  EXPECT_EQ(state_.points.size(), 1u);
  press("Escape");
  EXPECT_EQ(state_.tool, Tool::none);
}

}  // namespace
}  // namespace rakelight
