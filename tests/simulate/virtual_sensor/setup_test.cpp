// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "stack/errors.h"
#include "tests/support/message_of.h"

namespace rakelight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(VirtualSetup, AnEmptyObjectIsTheDefaultWithoutLamps) {
  const VirtualSensorSetup setup = parse_virtual_setup("{}");
  EXPECT_EQ(setup.scene, SceneKind::vase);
  EXPECT_EQ(setup.color_size, cv::Size(640, 480));
  EXPECT_EQ(setup.wiring.lamps, 0u);
}

TEST(VirtualSetup, ReadsSceneSizesHabitsAndFaultsByName) {
  const VirtualSensorSetup setup = parse_virtual_setup(R"({
    "scene": "coin", "albedo": "simple", "seed": 7, "color_size": [1280, 960], "response": "srgb",
    "lamps": [{"id": "a", "color": "white"}, {"id": "b", "color": "red", "position_m": [0.1, 0.2, 0.3]},
              {"id": "c", "color": "white"}],
    "lamp_jitter_us": 500, "drop_share": 0.05, "unplug_at_frame": 12,
    "stuck_on": ["b"], "dim": ["c"], "swapped": [["a", "c"]]})");
  EXPECT_EQ(setup.scene, SceneKind::coin);
  EXPECT_EQ(setup.color_size, cv::Size(1280, 960));
  EXPECT_EQ(setup.response.kind, ColorResponse::Kind::srgb);
  EXPECT_EQ(setup.wiring.lamps, 3u);
  EXPECT_DOUBLE_EQ(setup.wiring.jitter_us, 500);
  EXPECT_THAT(setup.wiring.stuck_on, ElementsAre(1u));
  EXPECT_THAT(setup.wiring.dim, ElementsAre(2u));
  EXPECT_THAT(setup.wiring.swapped, ElementsAre(Pair(0u, 2u)));
  EXPECT_DOUBLE_EQ(setup.lamps[1].position_m->z(), 0.3);
  EXPECT_DOUBLE_EQ(setup.frames.drop_share, 0.05);
  EXPECT_EQ(setup.frames.seed, 7u);
  EXPECT_EQ(setup.unplug_at_frame, 12);
}

TEST(VirtualSetup, RefusesUnknownWordsAndLampsByName) {
  EXPECT_THAT(test::message_of<InputError>([] { parse_virtual_setup(R"({"scene": "teapot"})"); }),
              HasSubstr("scene \"teapot\" is unknown (known: coin, drape"));
  EXPECT_THAT(test::message_of<InputError>([] { parse_virtual_setup(R"({"stuck_on": ["x"]})"); }),
              HasSubstr("\"x\", which is no lamp"));
  EXPECT_THROW(parse_virtual_setup("nonsense"), InputError);
}

}  // namespace
}  // namespace rakelight
