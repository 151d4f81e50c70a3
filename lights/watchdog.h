// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Calls something when it has not been stopped in time.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace rakelight {

/// Lives on a thread of its own. All but the destructor are called with `mutex` held, and so is `act`, on that thread.
class Watchdog {
 public:
  /// @param act if it throws, it is called again after a while until it does not or stop() is called
  Watchdog(std::chrono::milliseconds limit, std::mutex& mutex, std::function<void()> act);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// From now on `limit` runs anew; tripped() is false again.
  void start();
  void stop();
  bool tripped() const { return tripped_; }

 private:
  using Clock = std::chrono::steady_clock;
  void watch();
  void bite();

  std::chrono::milliseconds limit_;
  std::mutex& mutex_;
  std::function<void()> act_;
  std::condition_variable changed_;
  std::optional<Clock::time_point> deadline_;
  bool tripped_ = false;
  bool closing_ = false;
  std::thread thread_;
};

}  // namespace rakelight
