// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "lights/gpio_lookup.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rakelight {
namespace {

constexpr const char* kPermissionCure =
    "install hw/udev/60-rakelight.rules and join the group plugdev (gpio on a Raspberry Pi), then log in "
    "anew";

std::string wish_text(const GpioLine& wish) {
  if (!wish.name.empty()) return "line \"" + wish.name + "\"";
  return "line " + std::to_string(wish.offset) + " of chip \"" + wish.chip + "\"";
}

[[noreturn]] void fail(std::errc code, const GpioLine& wish, const std::string& fault) {
  throw std::system_error(std::make_error_code(code), "cannot find " + wish_text(wish) + ": " + fault);
}

bool is_meant(const GpioChip& chip, const std::string& chip_name) {
  return chip.path == chip_name || chip.name == chip_name || (!chip.fault && chip.label == chip_name);
}

std::string chip_list(const std::vector<GpioChip>& chips) {
  std::string text;
  for (const GpioChip& chip : chips) {
    text += (text.empty() ? "" : ", ") + chip.name;
    text += chip.fault ? " (unreadable)" : " (" + chip.label + ")";
  }
  return text.empty() ? "no GPIO chip at all" : text;
}

[[noreturn]] void fail_missing(const GpioLine& wish, const std::vector<GpioChip>& chips) {
  for (const GpioChip& chip : chips) {
    if (chip.fault == std::errc::permission_denied)
      fail(std::errc::permission_denied, wish, chip.path + " may not be opened; " + kPermissionCure);
  }
  fail(std::errc::no_such_device, wish,
       "there is " + chip_list(chips) + "; plug the board in or correct the rig");
}

FoundLine found(const GpioChip& chip, unsigned offset, const GpioLine& wish) {
  return {chip.path, chip.label, offset, wish.active_low};
}

/// Every line that fits.
std::vector<FoundLine> candidates(const GpioLine& wish, const std::vector<GpioChip>& chips) {
  std::vector<FoundLine> lines;
  for (const GpioChip& chip : chips) {
    if (wish.name.empty() && !is_meant(chip, wish.chip)) continue;
    if (!wish.chip.empty() && !is_meant(chip, wish.chip)) continue;
    for (const GpioLineInfo& line : chip.lines) {
      const bool fits = wish.name.empty() ? line.offset == wish.offset : line.name == wish.name;
      if (fits) lines.push_back(found(chip, line.offset, wish));
    }
  }
  return lines;
}

FoundLine find_line(const GpioLine& wish, const std::vector<GpioChip>& chips) {
  const std::vector<FoundLine> lines = candidates(wish, chips);
  if (lines.empty()) fail_missing(wish, chips);
  if (lines.size() > 1) {
    throw std::system_error(ENOTUNIQ, std::generic_category(),
                            "cannot tell which is " + wish_text(wish) + ": " + to_string(lines[0]) + " or " +
                                to_string(lines[1]) + "; name the chip by its number (gpiochipN)");
  }
  return lines.front();
}

void check_distinct(const std::vector<FoundLine>& lines) {
  for (auto a = lines.begin(); a != lines.end(); ++a) {
    const bool again = std::any_of(std::next(a), lines.end(), [&](const FoundLine& b) {
      return a->chip_path == b.chip_path && a->offset == b.offset;
    });
    if (again) throw std::invalid_argument("two lamps share " + to_string(*a) + "; give each its own line");
  }
}

std::string holder(const FoundLine& line, const std::vector<GpioChip>& chips) {
  for (const GpioChip& chip : chips) {
    if (chip.path == line.chip_path && line.offset < chip.lines.size())
      return chip.lines[line.offset].consumer;
  }
  return {};
}

std::string cause_and_cure(const std::error_code& code, const FoundLine& line,
                           const std::vector<GpioChip>& chips) {
  if (code == std::errc::device_or_resource_busy) {
    const std::string consumer = holder(line, chips);
    return consumer.empty()
               ? "another program or the kernel holds it; `rakelight lights list` shows all lines"
               : "\"" + consumer + "\" holds it; end that program first";
  }
  if (code == std::errc::permission_denied || code == std::errc::operation_not_permitted)
    return line.chip_path + " may not be opened; " + kPermissionCure;
  if (code == std::errc::no_such_device || code == std::errc::no_such_file_or_directory)
    return "the board has gone; plug it in again";
  return "see the kernel's log (dmesg)";
}

}  // namespace

std::string to_string(const FoundLine& line) {
  const std::string name = line.chip_path.substr(line.chip_path.rfind('/') + 1);
  return "line " + std::to_string(line.offset) + " of " + name + " (" + line.chip_label + ")";
}

std::vector<FoundLine> find_lines(const std::vector<GpioLine>& lines, const std::vector<GpioChip>& chips) {
  std::vector<FoundLine> all;
  all.reserve(lines.size());
  for (const GpioLine& wish : lines) all.push_back(find_line(wish, chips));
  check_distinct(all);
  return all;
}

std::system_error explain(const std::system_error& error, const FoundLine& line,
                          const std::vector<GpioChip>& chips) {
  return {error.code(),
          "cannot switch " + to_string(line) + ": " + cause_and_cure(error.code(), line, chips)};
}

}  // namespace rakelight
