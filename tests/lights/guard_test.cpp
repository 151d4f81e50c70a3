// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bank in shared memory outlives the program that switches it, as real lines do.
#include "lights/guard.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <new>
#include <system_error>
#include <thread>

namespace rakelight::test {
namespace {

using namespace std::chrono_literals;

struct Lamps {
  std::atomic<int> level{0};
  std::atomic<int> dark_writes{0};
  std::atomic<int> failures_to_come{0};
  std::atomic<bool> descriptor_open{false};  ///< in the process that wrote last
};

class SharedLamps {
 public:
  SharedLamps()
      : memory_(mmap(nullptr, sizeof(Lamps), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        lamps_(new (memory_) Lamps) {}
  ~SharedLamps() { munmap(memory_, sizeof(Lamps)); }
  SharedLamps(const SharedLamps&) = delete;
  SharedLamps& operator=(const SharedLamps&) = delete;
  Lamps* operator->() const { return lamps_; }
  Lamps& operator*() const { return *lamps_; }

 private:
  void* memory_;
  Lamps* lamps_;
};

/// Bears a descriptor, as a GPIO line does.
class SharedBank : public LineBank {
 public:
  explicit SharedBank(Lamps& lamps) : lamps_(lamps), fd_(open("/dev/null", O_RDWR | O_CLOEXEC)) {}
  ~SharedBank() override { close(fd_); }
  SharedBank(const SharedBank&) = delete;
  SharedBank& operator=(const SharedBank&) = delete;
  std::size_t size() const override { return 1; }
  void write(const std::vector<bool>& lit) override {
    if (!lit[0] && lamps_.failures_to_come > 0) {
      --lamps_.failures_to_come;
      throw std::system_error(std::make_error_code(std::errc::io_error), "cannot write");
    }
    lamps_.descriptor_open = fcntl(fd_, F_GETFD) != -1;
    lamps_.level = lit[0] ? 1 : 0;
    if (!lit[0]) ++lamps_.dark_writes;
  }
  std::vector<bool> read() override { return {lamps_.level != 0}; }

 private:
  Lamps& lamps_;
  int fd_;
};

std::unique_ptr<LineBank> open_shared(const SharedLamps& lamps, const GuardOptions& options = {}) {
  return open_guarded([&] { return std::make_unique<SharedBank>(*lamps); }, options);
}

template <class Condition>
bool comes_true(Condition condition) {
  for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(10ms);
  return condition();
}

/// Forks a program that lights the lamp and then waits for what comes.
pid_t light_in_another_process(const SharedLamps& lamps, const GuardOptions& options = {}) {
  const pid_t pid = fork();
  if (pid == 0) {
    const std::unique_ptr<LineBank> bank = open_shared(lamps, options);
    bank->write({true});
    for (;;) pause();
  }
  EXPECT_TRUE(comes_true([&] { return lamps->level == 1; }));
  return pid;
}

void end(pid_t pid, int signal) {
  kill(pid, signal);
  waitpid(pid, nullptr, 0);
}

TEST(Guard, SwitchesOffWhenTheProgramIsKilled) {
  const SharedLamps lamps;
  end(light_in_another_process(lamps), SIGKILL);
  EXPECT_TRUE(comes_true([&] { return lamps->level == 0; }));
  EXPECT_TRUE(lamps->descriptor_open);
}

TEST(Guard, SwitchesOffWhenTheProgramCrashes) {
  const SharedLamps lamps;
  end(light_in_another_process(lamps), SIGABRT);
  EXPECT_TRUE(comes_true([&] { return lamps->level == 0; }));
}

TEST(Guard, TriesAgainWhenALineFails) {
  const SharedLamps lamps;
  const pid_t pid = light_in_another_process(lamps);
  lamps->failures_to_come = 2;
  end(pid, SIGKILL);
  EXPECT_TRUE(comes_true([&] { return lamps->level == 0; }));
}

TEST(Guard, SwitchesOffWhenTheProgramIsStopped) {
  const SharedLamps lamps;
  GuardOptions options;
  options.max_on = 100ms;
  const pid_t pid = light_in_another_process(lamps, options);
  kill(pid, SIGSTOP);
  EXPECT_TRUE(comes_true([&] { return lamps->level == 0; }));
  end(pid, SIGKILL);
}

TEST(Guard, OutlivesTheSignalsOfATerminal) {
  const SharedLamps lamps;
  const pid_t pid = fork();
  if (pid == 0) {
    setpgid(0, 0);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_IGN);
    const std::unique_ptr<LineBank> bank = open_shared(lamps);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) kill(0, signal);  // the whole group, as Ctrl-C does
    bank->write({true});
    for (;;) pause();
  }
  ASSERT_TRUE(comes_true([&] { return lamps->level == 1; }));
  end(pid, SIGKILL);
  EXPECT_TRUE(comes_true([&] { return lamps->level == 0; }));
}

TEST(Guard, LeavesTheLinesAloneAfterAGoodbye) {
  const SharedLamps lamps;
  {
    const std::unique_ptr<LineBank> bank = open_shared(lamps);
    bank->write({true});
    bank->write({false});
  }
  EXPECT_EQ(lamps->dark_writes, 1);  // ours: the guard has ended, for the bank waits for it
}

TEST(Guard, HoldsNothingButTheLines) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const SharedLamps lamps;
  const std::unique_ptr<LineBank> bank = open_shared(lamps);
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0);  // the end comes although the guard lives
  close(ends[0]);
}

TEST(Guard, PassesOnWhatOpeningThrows) {
  const auto open = []() -> std::unique_ptr<LineBank> {
    throw std::system_error(std::make_error_code(std::errc::device_or_resource_busy), "busy");
  };
  EXPECT_THROW(open_guarded(open), std::system_error);
}

}  // namespace
}  // namespace rakelight::test
