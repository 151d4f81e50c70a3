// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/watchdog.h"

#include <utility>

#include "lights/signals_blocked.h"

namespace rakelight {
namespace {

constexpr std::chrono::milliseconds kRetry{100};

}  // namespace

Watchdog::Watchdog(std::chrono::milliseconds limit, std::mutex& mutex, std::function<void()> act)
    : limit_(limit), mutex_(mutex), act_(std::move(act)) {
  const SignalsBlocked blocked;  // signals are for the threads that wait for them
  thread_ = std::thread([this] { watch(); });
}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Watchdog::start() {
  deadline_ = Clock::now() + limit_;
  tripped_ = false;
  changed_.notify_one();
}

void Watchdog::stop() { deadline_.reset(); }

void Watchdog::watch() {
  std::unique_lock lock(mutex_);
  while (!closing_) {
    if (!deadline_) {
      changed_.wait(lock);
    } else if (Clock::now() < *deadline_) {
      changed_.wait_until(lock, Clock::time_point(*deadline_));  // a copy: stop() may take the deadline away
    } else {
      bite();
    }
  }
}

void Watchdog::bite() {
  tripped_ = true;
  try {
    act_();
    deadline_.reset();
  } catch (...) { deadline_ = Clock::now() + kRetry; }
}

}  // namespace rakelight
