// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A CP2112 that is plugged in while this lives, and what its pins did.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "tests/kernel/pins.h"

namespace rakelight::test {

/// Starts a program of the folder that this one is in.
pid_t start_program(const std::string& name, const std::vector<std::string>& arguments);

class FakeAdapter {
 public:
  /// Returns when the kernel has made a GPIO chip of it. @throws std::runtime_error if it does not
  FakeAdapter();
  ~FakeAdapter();
  FakeAdapter(const FakeAdapter&) = delete;
  FakeAdapter& operator=(const FakeAdapter&) = delete;

  void unplug();
  /// From now on the pin is at this level, whatever is written to it: stuck.
  void hold(int pin, bool high);

  /// "gpiochip0", or another number: the kernel does not use one again whose lines were held when it went.
  const std::string& chip() const { return chip_; }
  int levels() const { return pins_->levels; }
  std::uint32_t count() const { return pins_->count; }
  /// Writes since there were `count`, in order.
  std::vector<PinEvent> since(std::uint32_t count) const;

 private:
  Pins* pins_;
  pid_t pid_;
  std::string chip_;
};

}  // namespace rakelight::test
