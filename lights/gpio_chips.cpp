// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/gpio_chips.h"

#include <algorithm>
#include <filesystem>

#include "lights/gpio_backend.h"

namespace rakelight {
namespace {

namespace fs = std::filesystem;

GpioChip read_or_say_why_not(const std::string& path) {
  try {
    return read_gpio_chip(path);
  } catch (const std::system_error& error) {
    GpioChip chip;
    chip.path = path;
    chip.name = fs::path(path).filename();
    chip.fault = error.code();
    return chip;
  }
}

/// gpiochip10 comes after gpiochip9.
bool by_number(const std::string& a, const std::string& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

}  // namespace

std::vector<GpioChip> list_gpio_chips() {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator("/dev")) {
    if (entry.path().filename().string().rfind("gpiochip", 0) == 0 && entry.is_character_file())
      paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end(), by_number);
  std::vector<GpioChip> chips;
  for (const std::string& path : paths) chips.push_back(read_or_say_why_not(path));
  return chips;
}

}  // namespace rakelight
