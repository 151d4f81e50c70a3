// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/capture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <iostream>

#include "tests/capture/simulated_rig.h"

namespace rakelight {
namespace {

using test::simulated_rig;
using test::SimulatedRig;
using test::SimulatedRigOptions;

struct Outcome {
  ScanResult scan;
  int frames = 0, mislit = 0;
  std::int64_t start_us = 0, end_us = 0;
};

std::set<std::string> lamps_of(const std::optional<std::string>& light) {
  if (!light) return {};
  if (*light == "rgb") return {"red", "green", "blue"};
  return {*light};
}

Outcome scan(const SimulatedRigOptions& world, ScanOptions options = {}, const Rig* rig = nullptr) {
  const Rig own = rig != nullptr ? *rig : simulated_rig(world);
  SimulatedRig simulated(own, world);
  Outcome outcome;
  outcome.start_us = simulated.clock.now_us();
  outcome.scan = capture_stack({simulated.source(), simulated.lights(), simulated.clock}, own, options);
  outcome.end_us = simulated.clock.now_us();
  for (const Frame& frame : outcome.scan.stack.frames) {
    if (frame.color.empty() || !frame.lit_check->matches) continue;
    ++outcome.frames;
    if (!simulated.lit_only_by(*frame.color_time.device_us, lamps_of(frame.light))) ++outcome.mislit;
  }
  EXPECT_TRUE(simulated.lit_now().empty());
  return outcome;
}

TEST(Capture, TakesDarkFirstAndLastAndEachLampInItsOrder) {
  const Outcome outcome = scan({});
  std::vector<std::string> lights;
  for (const Frame& frame : outcome.scan.stack.frames) {
    if (!frame.color.empty()) lights.push_back(frame.light.value_or("dark"));
  }
  ASSERT_EQ(lights.size(), 17U);
  EXPECT_EQ(lights.front(), "dark");
  EXPECT_EQ(lights[1], "white-0");
  EXPECT_EQ(lights[15], "blue");
  EXPECT_EQ(lights.back(), "dark");
  EXPECT_EQ(outcome.mislit, 0);
  EXPECT_THAT(outcome.scan.warnings, testing::IsEmpty());
  EXPECT_THAT(outcome.scan.faults, testing::IsEmpty());
  std::cout << "whole scan " << double(outcome.end_us - outcome.start_us) * 1e-3 << " ms, sequence "
            << outcome.scan.sensor_time_us * 1e-3 << " ms, lag " << outcome.scan.lag_us << " rounds "
            << outcome.scan.metering_rounds << "\n";
}

}  // namespace
}  // namespace rakelight
