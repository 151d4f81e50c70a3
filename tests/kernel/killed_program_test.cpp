// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A program that switches lamps is ended at random moments. The fake adapter's pins change by writes only, so that a
// dark lamp means that "off" was written. To be run by tests/kernel/run_in_vm.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <random>
#include <thread>

#include "tests/kernel/fake_adapter.h"

namespace rakelight::test {
namespace {

using namespace std::chrono;

constexpr int kLines = 4;      // of lamp_cycler
constexpr int kDark = 0b1100;  // its lines 2 and 3 are active-low
constexpr int kMask = (1 << kLines) - 1;

class ProgramWithLamps : public testing::Test {
 protected:
  bool dark() const { return (adapter.levels() & kMask) == kDark; }

  /// As a scan would be when the first lamp is lit.
  void wait_for_light() const {
    for (int i = 0; i < 10000 && dark_so_far(); ++i) std::this_thread::sleep_for(1ms);
  }

  /// Whether the last write to each line was "off", and nothing was written to none of them.
  bool every_line_was_written_off() const {
    std::array<int, kLines> last{-1, -1, -1, -1};
    for (const PinEvent& event : adapter.since(start)) last.at(event.offset) = event.level;
    return last == std::array<int, kLines>{0, 0, 1, 1};
  }

  void sleep_up_to(milliseconds longest) {
    std::uniform_int_distribution<std::int64_t> us(0, duration_cast<microseconds>(longest).count());
    std::this_thread::sleep_for(microseconds(us(random)));
  }

  pid_t start_cycler() {
    start = adapter.count();
    return start_program("lamp_cycler", {});
  }

  FakeAdapter adapter;
  std::uint32_t start = 0;
  std::mt19937 random{4};

 private:
  /// Four lines are written on the request and four by Lights before anything is lit.
  bool dark_so_far() const { return adapter.count() < start + 2 * kLines + 1; }
};

TEST_F(ProgramWithLamps, WritesOffToEveryLineWhenInterruptedAtRandomMoments) {
  int written_off = 0, caught = 0;
  for (int run = 0; run < 100; ++run) {
    const pid_t pid = start_cycler();
    wait_for_light();
    sleep_up_to(40ms);
    kill(pid, run % 2 == 0 ? SIGINT : SIGTERM);
    int status = 0;
    waitpid(pid, &status, 0);
    caught += WIFEXITED(status) && WEXITSTATUS(status) == 130 ? 1 : 0;
    written_off += dark() && every_line_was_written_off() ? 1 : 0;
  }
  std::printf("FIGURE every line written off after SIGINT or SIGTERM: %d of 100\n", written_off);
  EXPECT_EQ(caught, 100);
  EXPECT_EQ(written_off, 100);
}

TEST_F(ProgramWithLamps, LeavesNothingLitWhenInterruptedWhileItStarts) {
  for (int run = 0; run < 20; ++run) {
    const pid_t pid = start_cycler();
    sleep_up_to(200ms);
    kill(pid, run % 2 == 0 ? SIGINT : SIGTERM);
    waitpid(pid, nullptr, 0);
    std::this_thread::sleep_for(20ms);  // killed before it could catch the signal: the guard's turn
    EXPECT_TRUE(adapter.count() == start || dark()) << "run " << run;
  }
}

TEST_F(ProgramWithLamps, HasAGuardThatWritesOffWithinASecondOfSigkill) {
  microseconds slowest{0};
  int written_off = 0;
  for (int run = 0; run < 30; ++run) {
    const pid_t pid = start_cycler();
    wait_for_light();
    sleep_up_to(40ms);
    const auto killed = steady_clock::now();
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    while (!(dark() && every_line_was_written_off()) && steady_clock::now() < killed + 5s)
      std::this_thread::sleep_for(200us);
    slowest = std::max(slowest, duration_cast<microseconds>(steady_clock::now() - killed));
    written_off += dark() ? 1 : 0;
    std::this_thread::sleep_for(50ms);  // the guard lets go of the lines
  }
  std::printf("FIGURE every line written off after SIGKILL: %d of 30, after %.1f ms at most\n", written_off,
              static_cast<double>(slowest.count()) / 1000);
  EXPECT_EQ(written_off, 30);
  EXPECT_LT(slowest, 1s);
}

}  // namespace
}  // namespace rakelight::test
