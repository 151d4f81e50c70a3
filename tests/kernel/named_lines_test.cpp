// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines that the firmware has named, on a GPIO chip that a driver of the running kernel drives (named-lines.asl). The witness
// of what a line does is the kernel's own list of lines. To be run by tests/kernel/run_in_vm.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "lights/gpio_bank.h"
#include "lights/gpio_chips.h"

namespace rakelight::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

void load(const char* module) {
  const int fd = open(module, O_RDONLY | O_CLOEXEC);
  if (fd < 0 || syscall(SYS_finit_module, fd, "", 0) != 0)
    throw std::runtime_error(std::string("cannot load ") + module);
  close(fd);
}

class GpioBankOnNamedLines : public testing::Test {
 protected:
  GpioBankOnNamedLines() {
    load("/run/named-lines/1.ko");
    load("/run/named-lines/2.ko");
    std::filesystem::create_directories("/run/debug");
    mount("debug", "/run/debug", "debugfs", 0, nullptr);
  }
  ~GpioBankOnNamedLines() override {
    umount("/run/debug");
    for (const char* module : {"gpio_amdpt", "gpio_generic"}) syscall(SYS_delete_module, module, O_NONBLOCK);
  }
  GpioBankOnNamedLines(const GpioBankOnNamedLines&) = delete;
  GpioBankOnNamedLines& operator=(const GpioBankOnNamedLines&) = delete;

  /// "hi" or "lo" of an output as the kernel lists it; empty for what is none.
  static std::string level(const std::string& name) {
    std::stringstream text;
    text << std::ifstream("/run/debug/gpio").rdbuf();
    std::smatch found;
    const std::string list = text.str();
    return std::regex_search(list, found, std::regex("\\(" + name + " *\\|rakelight *\\) out (hi|lo)"))
               ? found[1].str()
               : "";
  }

  static std::string error_of_opening(const GpioLine& line, std::errc expected) {
    try {
      open_gpio_bank({line});
    } catch (const std::system_error& error) {
      EXPECT_EQ(error.code(), expected) << error.what();
      return error.what();
    }
    return "";
  }
};

TEST_F(GpioBankOnNamedLines, AreListedWithTheirNames) {
  const std::vector<GpioChip> chips = list_gpio_chips();
  ASSERT_EQ(chips.size(), 1U);
  std::vector<std::string> names;
  for (const GpioLineInfo& line : chips[0].lines) names.push_back(line.name);
  EXPECT_THAT(names, ElementsAre("lamp-left", "lamp-right", "", "fan", "lamp-top", "twin", "twin", ""));
}

TEST_F(GpioBankOnNamedLines, AreSwitchedByNameAndReadBack) {
  Lights lights({"top", "left"}, open_gpio_bank({{"lamp-top", "", 0, false}, {"lamp-left", "", 0, true}}));
  EXPECT_EQ(level("lamp-top"), "lo");
  EXPECT_EQ(level("lamp-left"), "hi") << "active-low";
  EXPECT_EQ(level("lamp-right"), "") << "a line that is no lamp's stays untouched";
  lights.show({"left"});
  EXPECT_EQ(level("lamp-left"), "lo");
  EXPECT_THAT(lights.lit(), ElementsAre("left"));
  lights.show({"top"});
  EXPECT_EQ(level("lamp-top"), "hi");
  EXPECT_EQ(level("lamp-left"), "hi");
  EXPECT_THAT(lights.lit(), ElementsAre("top"));
}

TEST_F(GpioBankOnNamedLines, OneNameForTwoLinesIsRefused) {
  EXPECT_THAT(error_of_opening({"twin", "", 0, false}, std::errc(ENOTUNIQ)), HasSubstr("twin"));
}

TEST_F(GpioBankOnNamedLines, ANameThatNoLineHasIsRefused) {
  EXPECT_THAT(error_of_opening({"lamp-back", "", 0, false}, std::errc::no_such_device),
              HasSubstr("lamp-back"));
}

}  // namespace
}  // namespace rakelight::test
