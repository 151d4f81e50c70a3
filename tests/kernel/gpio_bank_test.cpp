// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lamps on a GPIO chip of a running kernel: to be run by tests/kernel/run_in_vm.
#include "lights/gpio_bank.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <system_error>

#include "lights/gpio_chips.h"
#include "lights/lights.h"
#include "tests/kernel/fake_adapter.h"

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GpioBankOnAKernel : public testing::Test {
 protected:
  /// By the chip's label, and one by its name.
  std::vector<GpioLine> lines(bool active_low = false) const {
    return {{"", "cp2112_gpio", 0, active_low},
            {"", "cp2112_gpio", 3, active_low},
            {"", adapter.chip(), 5, active_low}};
  }

  FakeAdapter adapter;
};

const std::vector<std::string> kIds = {"red", "green", "blue"};

/// "5=0 0=1": the pins that were written and their levels.
std::string text(const std::vector<PinEvent>& events) {
  std::string text;
  for (const PinEvent& event : events)
    text += (text.empty() ? "" : " ") + std::to_string(event.offset) + "=" + std::to_string(event.level);
  return text;
}

/// Code and message of what opening these lines throws.
std::pair<std::error_code, std::string> error_of_opening(const std::vector<GpioLine>& wanted) {
  try {
    open_gpio_bank(wanted);
  } catch (const std::system_error& error) { return {error.code(), error.what()}; }
  return {};
}

TEST_F(GpioBankOnAKernel, IsListed) {
  const std::vector<GpioChip> chips = list_gpio_chips();
  ASSERT_EQ(chips.size(), 1U);
  EXPECT_EQ(chips[0].path, "/dev/" + adapter.chip());
  EXPECT_EQ(chips[0].label, "cp2112_gpio");
  EXPECT_FALSE(chips[0].fault);
  ASSERT_EQ(chips[0].lines.size(), 8U);
  EXPECT_FALSE(chips[0].lines[3].used);
  EXPECT_FALSE(chips[0].lines[3].output);
}

TEST_F(GpioBankOnAKernel, ShowsWhoHoldsALine) {
  const Lights lights(kIds, open_gpio_bank(lines(true)));
  const GpioLineInfo line = list_gpio_chips().at(0).lines.at(3);
  EXPECT_TRUE(line.used);
  EXPECT_TRUE(line.output);
  EXPECT_TRUE(line.active_low);
  EXPECT_EQ(line.consumer, "rakelight");
}

TEST_F(GpioBankOnAKernel, SwitchesTheLinesOfTheLamps) {
  Lights lights(kIds, open_gpio_bank(lines()));
  EXPECT_EQ(adapter.levels(), 0);
  lights.show({"green"});
  EXPECT_EQ(adapter.levels(), 1 << 3);
  lights.show({"red", "blue"});
  EXPECT_EQ(adapter.levels(), (1 << 0) | (1 << 5));
  lights.all_off();
  EXPECT_EQ(adapter.levels(), 0);
}

TEST_F(GpioBankOnAKernel, DrivesActiveLowLinesTheOtherWayRound) {
  const int dark = (1 << 0) | (1 << 3) | (1 << 5);
  {
    Lights lights(kIds, open_gpio_bank(lines(true)));
    EXPECT_EQ(adapter.levels(), dark);
    lights.show({"green"});
    EXPECT_EQ(adapter.levels(), dark & ~(1 << 3));
  }
  EXPECT_EQ(adapter.levels(), dark);
}

TEST_F(GpioBankOnAKernel, WritesOffBeforeOnAndNothingElse) {
  Lights lights(kIds, open_gpio_bank(lines()));
  lights.show({"blue"});
  const std::uint32_t before = adapter.count();
  lights.show({"red"});  // a lower offset: in the adapter's own order it would come on first
  EXPECT_EQ(text(adapter.since(before)), "5=0 0=1");
}

TEST_F(GpioBankOnAKernel, WritesOffToEveryLineInTheEnd) {
  std::uint32_t before = 0;
  {
    Lights lights(kIds, open_gpio_bank(lines()));
    lights.show({"green"});
    before = adapter.count();
  }
  EXPECT_EQ(text(adapter.since(before)), "0=0 3=0 5=0");
}

TEST_F(GpioBankOnAKernel, EnclosesTheEdgesInTheTimesItTells) {
  Lights lights(kIds, open_gpio_bank(lines()));
  lights.show({"blue"});
  const std::uint32_t before = adapter.count();
  const SwitchTime time = lights.show({"red"});
  for (const PinEvent& event : adapter.since(before)) {
    EXPECT_GE(event.time_us, time.before_us);
    EXPECT_LE(event.time_us, time.after_us);
  }
}

TEST_F(GpioBankOnAKernel, SaysWhoHoldsABusyLine) {
  GpioBankOptions other;
  other.consumer = "blinker";
  const auto held = open_gpio_bank({{"", "cp2112_gpio", 3, false}}, other);
  const auto [code, message] = error_of_opening(lines());
  EXPECT_EQ(code, std::errc::device_or_resource_busy);
  EXPECT_THAT(message, AllOf(HasSubstr("line 3 of " + adapter.chip()), HasSubstr("\"blinker\" holds it")));
}

TEST_F(GpioBankOnAKernel, ReleasesItsLines) {
  open_gpio_bank(lines()).reset();
  EXPECT_FALSE(list_gpio_chips().at(0).lines.at(3).used);
  EXPECT_NO_THROW(open_gpio_bank(lines()));
}

TEST_F(GpioBankOnAKernel, TellsAPlainUserWhatPermissionToGet) {
  const pid_t pid = fork();
  if (pid == 0) {
    if (setuid(65534) != 0) _exit(2);
    const auto [code, message] = error_of_opening(lines());
    _exit(code == std::errc::permission_denied && message.find("hw/udev") != std::string::npos ? 0 : 1);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(GpioBankOnAKernel, NoticesThatTheBoardWasUnplugged) {
  Lights lights(kIds, open_gpio_bank(lines()));
  lights.show({"red"});
  adapter.unplug();
  try {
    lights.show({"green"});
    FAIL() << "nothing was noticed";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_device);
    EXPECT_THAT(error.what(), HasSubstr("the board has gone; plug it in again"));
  }
  EXPECT_EQ(error_of_opening(lines()).first, std::errc::no_such_device);
}

}  // namespace
}  // namespace rakelight::test
