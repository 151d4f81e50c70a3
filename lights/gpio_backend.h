// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The seam between libgpiod 1.6 (gpio_v1.cpp) and 2.x (gpio_v2.cpp); one of the two files is built.
#pragma once

#include <functional>
#include <string>

#include "lights/gpio_chips.h"

namespace rakelight {

/// A line, held while a copy of this lives. Both throw std::system_error.
struct OutputLine {
  std::function<void(bool lit)> set;
  std::function<bool()>
      get;  ///< the level that the chip tells, which is another than was set if the line is stuck
};

/// One request a line: adapters on USB change lines one by one anyway, and a line is written without its neighbours.
/// @throws std::system_error with the kernel's error number
OutputLine request_output(const std::string& chip_path, unsigned offset, bool active_low,
                          const std::string& consumer);

/// @throws std::system_error with the kernel's error number
GpioChip read_gpio_chip(const std::string& path);

}  // namespace rakelight
