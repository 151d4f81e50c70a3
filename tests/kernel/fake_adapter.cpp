// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/kernel/fake_adapter.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace rakelight::test {
namespace {

constexpr const char* kPinsFile = "/run/pins";

/// The one GPIO chip of the virtual machine, "gpiochip0"; empty where there is none.
std::string find_chip() {
  for (const auto& entry : std::filesystem::directory_iterator("/dev")) {
    const std::string name = entry.path().filename();
    if (name.rfind("gpiochip", 0) == 0) return name;
  }
  return {};
}

Pins* create_pins() {
  const int fd = open(kPinsFile, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0 || ftruncate(fd, sizeof(Pins)) != 0) throw std::runtime_error("cannot create /run/pins");
  void* memory = mmap(nullptr, sizeof(Pins), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  close(fd);
  if (memory == MAP_FAILED) throw std::runtime_error("cannot map /run/pins");
  return static_cast<Pins*>(memory);
}

}  // namespace

pid_t start_program(const std::string& name, const std::vector<std::string>& arguments) {
  std::string path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  std::vector<std::string> words = {path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    execv(path.c_str(), argv.data());
    _exit(127);
  }
  return pid;
}

FakeAdapter::FakeAdapter() : pins_(create_pins()), pid_(start_program("fake_cp2112", {kPinsFile})) {
  for (int i = 0; i < 1000 && chip_.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    chip_ = find_chip();
  }
  if (chip_.empty()) throw std::runtime_error("the kernel has made no GPIO chip of the fake adapter in 10 s");
}

FakeAdapter::~FakeAdapter() {
  unplug();
  munmap(pins_, sizeof(Pins));
}

void FakeAdapter::unplug() {
  if (pid_ == 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  pid_ = 0;
  for (int i = 0; i < 1000 && !find_chip().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

void FakeAdapter::hold(int pin, bool high) {
  const auto bit = static_cast<std::uint8_t>(1 << pin);
  pins_->held |= bit;
  if (high)
    pins_->levels |= bit;
  else
    pins_->levels &= static_cast<std::uint8_t>(~bit);
}

std::vector<PinEvent> FakeAdapter::since(std::uint32_t count) const {
  std::vector<PinEvent> events;
  for (std::uint32_t k = count; k < pins_->count; ++k) events.push_back(pins_->events[k % Pins::kCapacity]);
  return events;
}

}  // namespace rakelight::test
