// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// libgpiod 1.6 (Debian 12).
#include <gpiod.hpp>

#include "lights/gpio_backend.h"

namespace rakelight {

OutputLine request_output(const std::string& chip_path, unsigned offset, bool active_low,
                          const std::string& consumer) {
  const gpiod::chip chip(chip_path, gpiod::chip::OPEN_BY_PATH);
  const gpiod::line line = chip.get_line(offset);  // keeps the chip open
  gpiod::line_request request = {consumer, gpiod::line_request::DIRECTION_OUTPUT, {}};
  if (active_low) request.flags |= gpiod::line_request::FLAG_ACTIVE_LOW;
  line.request(request, 0);  // logical 0, as all levels here
  return {[line](bool lit) { line.set_value(lit ? 1 : 0); }, [line] { return line.get_value() != 0; }};
}

GpioChip read_gpio_chip(const std::string& path) {
  const gpiod::chip opened(path, gpiod::chip::OPEN_BY_PATH);
  GpioChip chip;
  chip.path = path;
  chip.name = opened.name();
  chip.label = opened.label();
  for (unsigned offset = 0; offset < opened.num_lines(); ++offset) {
    const gpiod::line line = opened.get_line(offset);
    GpioLineInfo info;
    info.offset = offset;
    info.name = line.name();
    info.consumer = line.consumer();
    info.used = line.is_used();
    info.output = line.direction() == gpiod::line::DIRECTION_OUTPUT;
    info.active_low = line.active_state() == gpiod::line::ACTIVE_LOW;
    chip.lines.push_back(info);
  }
  return chip;
}

}  // namespace rakelight
