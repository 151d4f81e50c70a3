// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lights the lamps of the fake adapter in turn until it is interrupted: what the tests kill at random moments.
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "cli/interrupt.h"
#include "lights/gpio_bank.h"

int main() try {
  rakelight::cli::catch_interrupts();
  const std::vector<std::string> ids = {"a", "b", "c", "d"};
  std::vector<rakelight::GpioLine> lines;
  for (unsigned offset = 0; offset < 4; ++offset) lines.push_back({"", "cp2112_gpio", offset, offset >= 2});
  rakelight::Lights lights(ids, rakelight::open_gpio_bank(lines));
  for (std::size_t k = 0; !rakelight::cli::interrupted(); ++k) {
    lights.show({ids[k % ids.size()]});
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  return 130;
} catch (const std::exception& error) {
  std::fprintf(stderr, "lamp_cycler: %s\n", error.what());
  return 4;
}
