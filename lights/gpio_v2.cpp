// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// libgpiod 2.x (Debian 13 and later).
#include <gpiod.hpp>
#include <memory>

#include "lights/gpio_backend.h"

namespace rakelight {

OutputLine request_output(const std::string& chip_path, unsigned offset, bool active_low,
                          const std::string& consumer) {
  gpiod::line_settings settings;
  settings.set_direction(gpiod::line::direction::OUTPUT)
      .set_active_low(active_low)
      .set_output_value(gpiod::line::value::INACTIVE);
  gpiod::chip chip(chip_path);
  auto request = std::make_shared<gpiod::line_request>(
      chip.prepare_request().set_consumer(consumer).add_line_settings(offset, settings).do_request());
  const auto set = [request, offset](bool lit) {
    request->set_value(offset, lit ? gpiod::line::value::ACTIVE : gpiod::line::value::INACTIVE);
  };
  return {set, [request, offset] { return request->get_value(offset) == gpiod::line::value::ACTIVE; }};
}

GpioChip read_gpio_chip(const std::string& path) {
  const gpiod::chip opened(path);
  const gpiod::chip_info about = opened.get_info();
  GpioChip chip;
  chip.path = path;
  chip.name = about.name();
  chip.label = about.label();
  for (unsigned offset = 0; offset < about.num_lines(); ++offset) {
    const gpiod::line_info line = opened.get_line_info(offset);
    GpioLineInfo info;
    info.offset = offset;
    info.name = line.name();
    info.consumer = line.consumer();
    info.used = line.used();
    info.output = line.direction() == gpiod::line::direction::OUTPUT;
    info.active_low = line.active_low();
    chip.lines.push_back(info);
  }
  return chip;
}

}  // namespace rakelight
