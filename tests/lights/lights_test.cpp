// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/lights.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace rakelight::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

/// What was written, one character a line: "0010".
struct Log {
  std::mutex mutex;
  std::vector<std::string> writes;
  int failures_to_come = 0;  ///< of writes that light a lamp
  int dark_failures_to_come = 0;

  std::vector<std::string> seen() {
    const std::lock_guard lock(mutex);
    return writes;
  }
};

class LoggingBank : public LineBank {
 public:
  LoggingBank(std::size_t size, Log& log) : size_(size), log_(log) {}
  std::size_t size() const override { return size_; }
  void write(const std::vector<bool>& lit) override {
    const std::lock_guard lock(log_.mutex);
    std::string levels;
    for (const bool level : lit) levels += level ? '1' : '0';
    log_.writes.push_back(levels);
    int& failures =
        levels.find('1') == std::string::npos ? log_.dark_failures_to_come : log_.failures_to_come;
    if (failures > 0) {
      --failures;
      throw std::system_error(std::make_error_code(std::errc::io_error), "cannot write");
    }
    levels_ = lit;
  }
  /// The last line is stuck off.
  std::vector<bool> read() override {
    std::vector<bool> levels = levels_;
    levels.back() = false;
    return levels;
  }

 private:
  std::size_t size_;
  std::vector<bool> levels_;
  Log& log_;
};

std::unique_ptr<LineBank> bank(Log& log) { return std::make_unique<LoggingBank>(3, log); }

const std::vector<std::string> kIds = {"red", "green", "blue"};

/// Patience for what another thread does; the tests do not measure it.
template <class Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(10ms);
  return condition();
}

TEST(Lights, ReadBackWhichLinesAreLitWhateverWasWritten) {
  Log log;
  Lights lights(kIds, bank(log));
  EXPECT_THAT(lights.lit(), ElementsAre());
  lights.show({"red", "blue"});
  EXPECT_THAT(lights.lit(), ElementsAre("red"));
}

TEST(Lights, AreOffFromTheStart) {
  Log log;
  const Lights lights(kIds, bank(log));
  EXPECT_THAT(log.seen(), ElementsAre("000"));
}

TEST(Lights, GoOffBeforeOthersComeOn) {
  Log log;
  Lights lights(kIds, bank(log));
  lights.show({"green"});
  lights.show({"red"});
  EXPECT_THAT(log.seen(), ElementsAre("000", "000", "010", "000", "100"));
}

TEST(Lights, ShowSeveralTogether) {
  Log log;
  Lights lights(kIds, bank(log));
  lights.show({"blue", "red", "green"});
  EXPECT_EQ(log.seen().back(), "111");
}

TEST(Lights, ShowNothingForAnEmptyList) {
  Log log;
  Lights lights(kIds, bank(log));
  lights.show({"red"});
  lights.show({});
  EXPECT_EQ(log.seen().back(), "000");
}

TEST(Lights, AreNotTakenForLitAfterNothingWasShown) {
  Log log;
  Lights lights(kIds, bank(log), {50ms});
  lights.show({"red"});
  lights.show({});
  std::this_thread::sleep_for(150ms);
  EXPECT_FALSE(lights.watchdog_tripped());
}

TEST(Lights, AreOffAfterDestruction) {
  Log log;
  { Lights(kIds, bank(log)).show({"red"}); }
  EXPECT_EQ(log.seen().back(), "000");
}

TEST(Lights, AreOffAfterAnException) {
  Log log;
  try {
    Lights lights(kIds, bank(log));
    lights.show({"red"});
    throw std::runtime_error("the sensor has gone");
  } catch (const std::runtime_error&) {}
  EXPECT_EQ(log.seen().back(), "000");
}

TEST(Lights, AreSwitchedOffWhenALineFails) {
  Log log;
  Lights lights(kIds, bank(log));
  log.failures_to_come = 1;
  EXPECT_THROW(lights.show({"red"}), std::system_error);
  EXPECT_EQ(log.seen().back(), "000");
}

TEST(Lights, RefuseAnUnknownIdBeforeTheySwitchAnything) {
  Log log;
  Lights lights(kIds, bank(log));
  EXPECT_THROW(lights.show({"red", "ultraviolet"}), std::invalid_argument);
  EXPECT_THAT(log.seen(), ElementsAre("000"));
}

TEST(Lights, NeedOneIdALine) {
  Log log;
  EXPECT_THROW(Lights({"red"}, bank(log)), std::invalid_argument);
  EXPECT_THROW(Lights({"red", "red", "blue"}, bank(log)), std::invalid_argument);
}

TEST(Lights, SayWhenTheySwitched) {
  Log log;
  Lights lights(kIds, bank(log));
  const SwitchTime first = lights.show({"red"});
  const SwitchTime second = lights.all_off();
  EXPECT_LE(first.before_us, first.after_us);
  EXPECT_LE(first.after_us, second.before_us);
  EXPECT_LE(second.before_us, second.after_us);
}

TEST(LightsWatchdog, SwitchesOffWhatIsLitForTooLong) {
  Log log;
  LightsOptions options;
  options.max_on = 20ms;
  Lights lights(kIds, bank(log), options);
  lights.show({"red"});
  EXPECT_TRUE(comes_true([&] { return lights.watchdog_tripped(); }));
  EXPECT_EQ(log.seen().back(), "000");
}

TEST(LightsWatchdog, TriesAgainUntilTheLampIsOff) {
  Log log;
  LightsOptions options;
  options.max_on = 20ms;
  Lights lights(kIds, bank(log), options);
  lights.show({"red"});
  {
    const std::lock_guard lock(log.mutex);
    log.dark_failures_to_come = 2;
  }
  // construction, off before on, on, two failures and the one that works
  EXPECT_TRUE(comes_true([&] { return log.seen().size() >= 6; }));
}

TEST(LightsWatchdog, LeavesAloneWhatGoesOffInTime) {
  Log log;
  LightsOptions options;
  options.max_on = 1h;
  Lights lights(kIds, bank(log), options);
  lights.show({"red"});
  lights.all_off();
  EXPECT_FALSE(lights.watchdog_tripped());
  EXPECT_THAT(log.seen(), ElementsAre("000", "000", "100", "000"));
}

}  // namespace
}  // namespace rakelight::test
