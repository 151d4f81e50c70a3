// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace rakelight {
namespace {

const Eigen::Vector3f kCenter(0, 0, 1);

LampTruth lamp(bool near, const Eigen::Vector3d& position) {
  LampTruth truth;
  truth.near = near;
  truth.position_m = position;
  truth.direction = (position - kCenter.cast<double>()).normalized();
  truth.strength = {1, 2, 3};
  return truth;
}

TEST(Lamps, ANearLampFallsOffWithTheSquareOfDistanceAndTheCosineOfItsLobe) {
  const LampTruth near = lamp(true, {0.3, -0.2, 0.1});
  const Eigen::Vector3f point(0.1f, 0.25f, 0.9f);
  const Incident light = incident_light(near, kCenter, point);
  const Eigen::Vector3d to_lamp = *near.position_m - point.cast<double>();
  const Eigen::Vector3d axis = *near.position_m - kCenter.cast<double>();
  const double cosine = to_lamp.normalized().dot(axis.normalized());
  const double expected = cosine * axis.squaredNorm() / to_lamp.squaredNorm();
  EXPECT_NEAR(light.irradiance.x(), 1 * expected, 1e-5);
  EXPECT_NEAR(light.irradiance.z(), 3 * expected, 1e-5);
  EXPECT_NEAR(light.distance, to_lamp.norm(), 1e-6);
  EXPECT_GT(light.direction.cast<double>().dot(to_lamp.normalized()), 1 - 1e-6);
}

TEST(Lamps, ANearLampHasItsStrengthAtTheObjectsCentre) {
  const Incident light = incident_light(lamp(true, {0.3, -0.2, 0.1}), kCenter, kCenter);
  EXPECT_NEAR(light.irradiance.y(), 2.0, 1e-5);
}

TEST(Lamps, ALampLightsNothingBehindItself) {
  const Incident light = incident_light(lamp(true, {0, 0, 0.5}), kCenter, {0, 0.1f, 0.2f});
  EXPECT_EQ(light.irradiance.norm(), 0);
}

TEST(Lamps, AFarLampIsTheSameEverywhere) {
  const LampTruth far = lamp(false, {0.3, -0.2, 0.1});
  const Incident here = incident_light(far, kCenter, {0, 0, 1}),
                 there = incident_light(far, kCenter, {0.4f, 0, 2});
  EXPECT_EQ(here.direction, there.direction);
  EXPECT_EQ(here.irradiance, there.irradiance);
  EXPECT_TRUE(std::isinf(here.distance));
}

TEST(Lamps, TheSequenceIsDarkThenRgbThenWhite) {
  SimulateOptions options;
  options.lamps.count = 5;
  options.lamps.rgb = true;
  const auto sets = make_lamp_sets(options);
  ASSERT_EQ(sets.size(), 7U);
  EXPECT_TRUE(sets[0].lamps.empty());
  ASSERT_EQ(sets[1].lamps.size(), 3U);
  EXPECT_EQ(sets[1].light.color, LampColor::rgb);
  for (int c = 0; c < 3; ++c) {
    const auto& strength = sets[1].lamps[static_cast<std::size_t>(c)].strength;
    EXPECT_EQ(strength, Eigen::Vector3d(Eigen::Vector3d::Unit(c)));
  }
  std::set<std::string> ids;
  for (std::size_t k = 2; k < sets.size(); ++k) {
    EXPECT_EQ(sets[k].lamps.size(), 1U);
    EXPECT_EQ(sets[k].light.color, LampColor::white);
    ids.insert(sets[k].light.id);
  }
  EXPECT_EQ(ids.size(), 5U);
}

class EveryLayout : public testing::TestWithParam<LampLayout> {};

TEST_P(EveryLayout, LampsStandBeforeTheObjectAroundIt) {
  SimulateOptions options;
  options.lamps.layout = GetParam();
  options.lamps.near = true;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& set : make_lamp_sets(options)) {
    for (const auto& one : set.lamps) {
      const double angle = std::acos(-one.direction.z()) * 180 / M_PI;
      EXPECT_GT(angle, 5);
      EXPECT_LT(angle, 75);
      EXPECT_NEAR((*one.position_m - Eigen::Vector3d(0, 0, 1)).norm(), 0.8, 0.8 * 0.3);
      sum += one.direction / options.lamps.count;
    }
  }
  EXPECT_LT(sum.head<2>().norm(), 0.35) << "all lamps stand on one side";
}

INSTANTIATE_TEST_SUITE_P(Layouts, EveryLayout, testing::Values(LampLayout::ring, LampLayout::swayed));

TEST(Lamps, TheStackLearnsPositionsOnlyWhenAsked) {
  SimulateOptions options;
  options.lamps.near = true;
  EXPECT_FALSE(make_lamp_sets(options).back().light.position_m.has_value());
  options.lamps.write_positions = true;
  const auto set = make_lamp_sets(options).back();
  ASSERT_TRUE(set.light.position_m.has_value());
  EXPECT_EQ(*set.light.position_m, *set.lamps.front().position_m);
}

}  // namespace
}  // namespace rakelight
