// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What GPIO chips there are, and who holds which line.
#pragma once

#include <string>
#include <system_error>
#include <vector>

namespace rakelight {

struct GpioLineInfo {
  unsigned offset = 0;
  std::string name;      ///< empty where the line has none, as on USB adapters
  std::string consumer;  ///< who holds it; may be empty although it is used
  bool used = false;
  bool output = false;
  bool active_low = false;
};

struct GpioChip {
  std::string path;   ///< /dev/gpiochip0
  std::string name;   ///< gpiochip0
  std::string label;  ///< the driver's word, such as "cp2112_gpio"
  std::vector<GpioLineInfo> lines;
  std::error_code fault;  ///< set where it could not be read: only path and name are known then
};

/// All chips of the system, by number. Those that may not be opened are listed with their fault.
std::vector<GpioChip> list_gpio_chips();

}  // namespace rakelight
