// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a line as a rig names it to a chip and an offset.
#pragma once

#include <string>
#include <vector>

#include "lights/gpio_bank.h"
#include "lights/gpio_chips.h"

namespace rakelight {

/// A line that exists.
struct FoundLine {
  std::string chip_path, chip_label;
  unsigned offset = 0;
  bool active_low = false;
};

/// "line 3 of gpiochip0 (cp2112_gpio)".
std::string to_string(const FoundLine& line);

/// @throws std::system_error ENODEV where there is no such chip or line, EACCES where it may be on a chip that may not
/// be opened, ENOTUNIQ where several fit; std::invalid_argument where two of `lines` are one
std::vector<FoundLine> find_lines(const std::vector<GpioLine>& lines, const std::vector<GpioChip>& chips);

/// Says why `line` cannot be had or switched, and what to do. @param chips as they are now
std::system_error explain(const std::system_error& error, const FoundLine& line,
                          const std::vector<GpioChip>& chips);

}  // namespace rakelight
