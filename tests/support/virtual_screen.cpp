// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/virtual_screen.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rakelight::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kPatience = std::chrono::seconds(30);
constexpr auto kHeld = std::chrono::milliseconds(200);

void run_tool(const std::string& command) {
  if (std::system(("xdotool " + command + " >/dev/null 2>&1").c_str()) != 0)
    throw std::runtime_error("xdotool " + command + " failed");
  std::this_thread::sleep_for(kHeld);
}

/// Xvfb with the display number it chose; its screen is a file in `folder`.
pid_t start_server(const std::string& screen, const std::string& folder, std::string& display) {
  std::array<int, 2> pipe_ends{};
  if (pipe(pipe_ends.data()) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t server = fork();
  if (server < 0) throw std::runtime_error("cannot fork");
  if (server == 0) {
    const std::string number = std::to_string(pipe_ends[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", screen.c_str(), "-fbdir",
           folder.c_str(), "-nolisten", "tcp", static_cast<char*>(nullptr));
    _exit(127);
  }
  close(pipe_ends[1]);
  char letter = 0;
  display = ":";
  while (read(pipe_ends[0], &letter, 1) == 1 && letter != '\n') display += letter;
  close(pipe_ends[0]);
  return server;
}

}  // namespace

bool VirtualScreen::is_available() {
  return std::system("command -v Xvfb >/dev/null && command -v xdotool >/dev/null") == 0;
}

VirtualScreen::VirtualScreen(int width, int height) {
  std::string display;
  const std::string screen = std::to_string(width) + "x" + std::to_string(height) + "x24";
  server_ = start_server(screen, folder_.path().string(), display);
  if (display == ":") throw std::runtime_error("Xvfb did not start");
  setenv("DISPLAY", display.c_str(), 1);
}

VirtualScreen::~VirtualScreen() {
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
  unsetenv("DISPLAY");
}

void VirtualScreen::end() const { kill(server_, SIGKILL); }

/// The file is an X window dump: 25 big-endian words of header, a colour table, rows of B G R x.
cv::Mat3b VirtualScreen::look() const {
  std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
  const std::vector<unsigned char> bytes{std::istreambuf_iterator<char>(file), {}};
  const auto word = [&bytes](std::size_t index) {
    std::size_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + bytes.at(4 * index + i);
    return value;
  };
  const std::size_t start = word(0) + 12 * word(19), row_bytes = word(12);
  cv::Mat3b picture(static_cast<int>(word(5)), static_cast<int>(word(4)));
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const std::size_t at =
          start + static_cast<std::size_t>(y) * row_bytes + 4 * static_cast<std::size_t>(x);
      picture(y, x) = {bytes.at(at + 2), bytes.at(at + 1), bytes.at(at)};
    }
  }
  return picture;
}

cv::Mat3b VirtualScreen::look_when_still() const {
  constexpr auto kStill = std::chrono::milliseconds(700);
  const auto end = Clock::now() + kPatience;
  cv::Mat3b last = look();
  for (auto since = Clock::now(); Clock::now() < end && Clock::now() - since < kStill;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const cv::Mat3b now = look();
    if (cv::norm(now, last, cv::NORM_INF) > 0) since = Clock::now();
    last = now;
  }
  return last;
}

bool VirtualScreen::wait_for(const std::function<bool(const cv::Mat3b&)>& wanted) const {
  for (const auto end = Clock::now() + kPatience; Clock::now() < end;) {
    if (wanted(look())) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

void VirtualScreen::key(const std::string& name) const {
  run_tool("keydown " + name);
  run_tool("keyup " + name);
}

void VirtualScreen::move_to(const cv::Point& at) const {
  run_tool("mousemove " + std::to_string(at.x) + " " + std::to_string(at.y));
}

void VirtualScreen::click(const cv::Point& at) const {
  move_to(at);
  run_tool("mousedown 1");
  run_tool("mouseup 1");
}

void VirtualScreen::drag(const cv::Point& from, const cv::Point& to, int button) const {
  move_to(from);
  run_tool("mousedown " + std::to_string(button));
  move_to((from + to) / 2);
  move_to(to);
  run_tool("mouseup " + std::to_string(button));
}

}  // namespace rakelight::test
