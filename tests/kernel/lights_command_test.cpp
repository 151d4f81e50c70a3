// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `rakelight lights` on a GPIO chip of a running kernel: to be run by tests/kernel/run_in_vm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "lights/gpio_bank.h"
#include "tests/kernel/fake_adapter.h"
#include "tests/support/run_program.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

constexpr const char* kRig = "/run/rig.toml";

class LightsCommandOnAKernel : public testing::Test {
 protected:
  LightsCommandOnAKernel() {
    std::ofstream(kRig)
        << "max_on_ms = 60000\n"
           "[[lamps]]\nid = \"left\"\nchip = \"cp2112_gpio\"\noffset = 2\n"
           "[[lamps]]\nid = \"right\"\nchip = \"cp2112_gpio\"\noffset = 4\nactive_low = true\n";
  }
  FakeAdapter adapter;
  const int dark = 1 << 4;
};

TEST_F(LightsCommandOnAKernel, ListsLinesLampsAndHolders) {
  GpioBankOptions blinker;
  blinker.consumer = "blinker";
  const auto held = open_gpio_bank({{"", "cp2112_gpio", 0, false}}, blinker);
  const Ran ran = run({"lights", "list", "--rig", kRig});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr(adapter.chip() + " (cp2112_gpio)"), HasSubstr("held by blinker"),
                             ContainsRegex("2  -  .*input .*free  .*left")));
}

TEST_F(LightsCommandOnAKernel, TestsEachLampInTurn) {
  const std::uint32_t before = adapter.count();
  const Ran ran = run({"lights", "test", "--rig", kRig, "--each", "0.01"});
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("left"), HasSubstr("cp2112_gpio line 4 (active low)")));
  std::string lit;
  for (const PinEvent& event : adapter.since(before)) {
    if (event.offset == 2 && event.level == 1) lit += "left ";
    if (event.offset == 4 && event.level == 0) lit += "right ";
  }
  EXPECT_EQ(lit, "left right ");
  EXPECT_EQ(adapter.levels(), dark);
}

TEST_F(LightsCommandOnAKernel, LightsALampUntilItIsInterrupted) {
  RunningProgram program({"lights", "on", "left", "right", "--rig", kRig});
  for (int i = 0; i < 3000 && adapter.levels() != 1 << 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_EQ(adapter.levels(), 1 << 2);
  program.send(SIGINT);
  const Ran ran = program.wait();
  EXPECT_EQ(ran.exit_code, 130);
  EXPECT_EQ(ran.err, "rakelight: error: lights: interrupted; the lamps are off\n");
  EXPECT_EQ(adapter.levels(), dark);
}

TEST_F(LightsCommandOnAKernel, NamesWhoHoldsTheLineOfALamp) {
  GpioBankOptions blinker;
  blinker.consumer = "blinker";
  const auto held = open_gpio_bank({{"", "cp2112_gpio", 4, false}}, blinker);
  const Ran ran = run({"lights", "off", "--rig", kRig});
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_THAT(ran.err, HasSubstr("line 4 of " + adapter.chip() + " (cp2112_gpio): \"blinker\" holds it"));
}

}  // namespace
}  // namespace rakelight::test
