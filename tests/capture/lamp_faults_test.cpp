// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/lamp_faults.h"

#include <gmock/gmock.h>

#include "capture/capture.h"
#include "tests/capture/simulated_rig.h"

namespace rakelight {
namespace {

using test::simulated_rig;
using test::SimulatedRig;
using test::SimulatedRigOptions;
using Kind = LampFault::Kind;

constexpr int kTrials = 100;

/// A picture large enough to tell where light comes from, noise and timing by `seed`.
SimulatedRigOptions world_of(unsigned seed) {
  SimulatedRigOptions world;
  world.width = 64;
  world.height = 48;
  world.seed = seed;
  world.phase_us = 977.0 * seed;
  world.delivery_jitter_us = 5000;
  return world;
}

std::vector<LampFault> faults_of(const SimulatedRigOptions& world) {
  const Rig rig = simulated_rig(world);
  SimulatedRig simulated(rig, world);
  return capture_stack({simulated.source(), simulated.lights(), simulated.clock}, rig, {}).faults;
}

std::string lamp_number(unsigned k) { return simulated_rig({}).lamps[k % 15].id; }

TEST(LampFaults, NoneIsNamedInTwoHundredScansOfAGoodRig) {
  int alarms = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    for (const LampFault& fault : faults_of(world_of(seed))) {
      ++alarms;
      ADD_FAILURE() << "scan " << seed << ": " << fault.message;
    }
  }
  EXPECT_EQ(alarms, 0);
}

/// How often exactly this one fault was named.
template <class Break>
int times_named(Kind kind, const Break& break_lamp) {
  int named = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    SimulatedRigOptions world = world_of(seed);
    const std::string lamp = lamp_number(seed);
    break_lamp(world, lamp);
    const std::vector<LampFault> faults = faults_of(world);
    const bool right = faults.size() == 1 && faults[0].kind == kind && faults[0].lamp == lamp;
    named += right ? 1 : 0;
    EXPECT_TRUE(right) << "scan " << seed << ", lamp " << lamp << ": "
                       << (faults.empty() ? "nothing named" : faults[0].message);
  }
  return named;
}

TEST(LampFaults, NamesALampThatIsStuckOn) {
  EXPECT_EQ(times_named(Kind::stuck_on, [](auto& world, const auto& lamp) { world.stuck_on = {lamp}; }),
            kTrials);
}

TEST(LampFaults, TellsALampThatIsStuckOnFromADeadOneBesideIt) {
  int named = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    SimulatedRigOptions world = world_of(seed);
    const unsigned stuck = seed % 12, dead = (stuck + 2 + seed / 12 % 9) % 12;  // 60 degrees apart or more
    world.stuck_on = {lamp_number(stuck)};
    world.stuck_off = {lamp_number(dead)};
    std::set<std::string> found;
    for (const LampFault& fault : faults_of(world)) found.insert(to_string(fault.kind) + " " + fault.lamp);
    const bool right =
        found == std::set<std::string>{"stuck-on " + lamp_number(stuck), "no-light " + lamp_number(dead)};
    named += right ? 1 : 0;
    EXPECT_TRUE(right) << "scan " << seed << ", stuck " << lamp_number(stuck) << ", dead "
                       << lamp_number(dead) << ": " << testing::PrintToString(found);
  }
  EXPECT_EQ(named, kTrials);
}

TEST(LampFaults, NamesALampThatGivesNoLight) {
  EXPECT_EQ(times_named(Kind::no_light, [](auto& world, const auto& lamp) { world.stuck_off = {lamp}; }),
            kTrials);
}

TEST(LampFaults, NamesABurntOutLampInABrightRoomWhichLooksLikeAStuckOne) {
  const auto burn_out = [](auto& world, const auto& lamp) {
    world.ambient = 0.3;
    world.stuck_off = {lamp};
  };
  EXPECT_EQ(times_named(Kind::no_light, burn_out), kTrials);
}

TEST(LampFaults, NamesADimLamp) {
  EXPECT_EQ(times_named(Kind::dim, [](auto& world, const auto& lamp) { world.dim = {lamp}; }), kTrials);
}

TEST(LampFaults, NamesTwoLampsThatAreSwapped) {
  int named = 0;
  for (unsigned seed = 0; seed < kTrials; ++seed) {
    SimulatedRigOptions world = world_of(seed);
    const unsigned i = seed % 15, j = (i + 1 + seed / 15) % 15;
    const std::string first = lamp_number(std::min(i, j)), second = lamp_number(std::max(i, j));
    world.swapped = {{first, second}};
    const std::vector<LampFault> faults = faults_of(world);
    const bool right = faults.size() == 1 && faults[0].kind == Kind::swapped && faults[0].lamp == first &&
                       faults[0].other == second;
    named += right ? 1 : 0;
    EXPECT_TRUE(right) << "scan " << seed << ", " << first << " and " << second << ": "
                       << (faults.empty() ? "nothing named" : faults[0].message);
  }
  EXPECT_EQ(named, kTrials);
}

TEST(LampFaults, LeavesOutTheImagesOfALampWithoutLight) {
  SimulatedRigOptions world = world_of(1);
  world.stuck_off = {"white-3"};
  const Rig rig = simulated_rig(world);
  SimulatedRig simulated(rig, world);
  const ScanResult scan = capture_stack({simulated.source(), simulated.lights(), simulated.clock}, rig, {});
  for (const Frame& frame : scan.stack.frames) EXPECT_NE(frame.light, "white-3");
  EXPECT_THAT(scan.warnings, testing::Contains(testing::HasSubstr("'white-3' gives no light")));
}

}  // namespace
}  // namespace rakelight
