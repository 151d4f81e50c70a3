// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/gpio_lookup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rakelight::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

GpioChip chip(int number, const std::string& label, const std::vector<std::string>& names) {
  GpioChip chip;
  chip.name = "gpiochip" + std::to_string(number);
  chip.path = "/dev/" + chip.name;
  chip.label = label;
  for (const std::string& name : names) {
    GpioLineInfo line;
    line.offset = static_cast<unsigned>(chip.lines.size());
    line.name = name;
    chip.lines.push_back(line);
  }
  return chip;
}

const std::vector<GpioChip> kChips = {chip(0, "pinctrl-bcm2835", {"ID_SDA", "GPIO17", "GPIO22"}),
                                      chip(1, "cp2112_gpio", {"", "", ""})};

GpioLine by_name(const std::string& name) { return {name, "", 0, false}; }
GpioLine by_offset(const std::string& chip, unsigned offset) { return {"", chip, offset, true}; }

/// Code and message of what looking up throws.
std::pair<std::error_code, std::string> error_of(const GpioLine& wish, const std::vector<GpioChip>& chips) {
  try {
    find_lines({wish}, chips);
  } catch (const std::system_error& error) { return {error.code(), error.what()}; }
  return {};
}

TEST(GpioLookup, FindsALineByItsName) {
  EXPECT_EQ(to_string(find_lines({by_name("GPIO22")}, kChips).front()),
            "line 2 of gpiochip0 (pinctrl-bcm2835)");
}

TEST(GpioLookup, FindsALineByLabelNameOrPathOfItsChip) {
  for (const char* name : {"cp2112_gpio", "gpiochip1", "/dev/gpiochip1"}) {
    const FoundLine line = find_lines({by_offset(name, 1)}, kChips).front();
    EXPECT_EQ(line.chip_path, "/dev/gpiochip1");
    EXPECT_EQ(line.offset, 1U);
    EXPECT_TRUE(line.active_low);
  }
}

TEST(GpioLookup, NamesTheChipsThereAreWhenOneIsMissing) {
  const auto [code, message] = error_of(by_offset("ftdi-cbus", 0), kChips);
  EXPECT_EQ(code, std::errc::no_such_device);
  EXPECT_THAT(message,
              AllOf(HasSubstr("line 0 of chip \"ftdi-cbus\""), HasSubstr("gpiochip1 (cp2112_gpio)")));
  EXPECT_THAT(error_of(by_name("GPIO5"), {}).second, HasSubstr("no GPIO chip at all"));
}

TEST(GpioLookup, RefusesAnOffsetBeyondTheChip) {
  EXPECT_EQ(error_of(by_offset("cp2112_gpio", 3), kChips).first, std::errc::no_such_device);
}

TEST(GpioLookup, SuspectsTheChipThatItMayNotOpen) {
  std::vector<GpioChip> chips = kChips;
  chips[1].fault = std::make_error_code(std::errc::permission_denied);
  chips[1].lines.clear();
  const auto [code, message] = error_of(by_offset("cp2112_gpio", 1), chips);
  EXPECT_EQ(code, std::errc::permission_denied);
  EXPECT_THAT(message, AllOf(HasSubstr("/dev/gpiochip1 may not be opened"), HasSubstr("hw/udev")));
}

TEST(GpioLookup, RefusesToChooseBetweenTwoBoards) {
  std::vector<GpioChip> chips = kChips;
  chips.push_back(chip(2, "cp2112_gpio", {"", ""}));
  const auto [code, message] = error_of(by_offset("cp2112_gpio", 1), chips);
  EXPECT_EQ(code.value(), ENOTUNIQ);
  EXPECT_THAT(message, AllOf(HasSubstr("gpiochip1"), HasSubstr("gpiochip2")));
}

TEST(GpioLookup, RefusesTwoLampsOnOneLine) {
  EXPECT_THROW(find_lines({by_name("GPIO17"), by_offset("gpiochip0", 1)}, kChips), std::invalid_argument);
}

TEST(GpioLookup, NamesWhoHoldsABusyLine) {
  std::vector<GpioChip> chips = kChips;
  chips[1].lines[1].consumer = "blinker";
  const FoundLine line = find_lines({by_offset("cp2112_gpio", 1)}, chips).front();
  const std::system_error busy(std::make_error_code(std::errc::device_or_resource_busy));
  EXPECT_THAT(explain(busy, line, chips).what(),
              AllOf(HasSubstr("cannot switch line 1 of gpiochip1"), HasSubstr("\"blinker\" holds it")));
}

TEST(GpioLookup, SaysThatTheBoardHasGone) {
  const FoundLine line = find_lines({by_offset("cp2112_gpio", 1)}, kChips).front();
  const std::system_error gone(std::make_error_code(std::errc::no_such_device));
  EXPECT_THAT(explain(gone, line, {}).what(), HasSubstr("plug it in again"));
}

}  // namespace
}  // namespace rakelight::test
