// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps on GPIO lines of the kernel's character devices, over libgpiod 1.6 or 2.x.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "lights/lights.h"

namespace rakelight {

/// One GPIO line. Either `name`, or `chip` (a label such as "cp2112_gpio", a name such as "gpiochip0" or a path such
/// as "/dev/gpiochip0") with `offset`.
struct GpioLine {
  std::string name;
  std::string chip;
  unsigned offset = 0;
  bool active_low = false;  ///< the lamp is lit while the line is low
};

struct GpioBankOptions {
  std::string consumer = "rakelight";  ///< who holds the lines, as others see it
  std::chrono::milliseconds max_on{
      2500};  ///< what is lit for longer without a new write, the guard switches off
};

/// Requests all lines as outputs, off, and starts a guard process that switches them off if this one cannot (see
/// lights/guard.h). Call it before starting threads.
/// @throws std::system_error, one line with the cure: ENODEV (no such chip or line), EACCES (no permission), EBUSY (who
/// holds the line); std::invalid_argument where two lamps share a line
std::unique_ptr<LineBank> open_gpio_bank(const std::vector<GpioLine>& lines,
                                         const GpioBankOptions& options = {});

}  // namespace rakelight
