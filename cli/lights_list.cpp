// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/lights_list.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "capture/rig_lights.h"
#include "lights/gpio_chips.h"
#include "lights/gpio_lookup.h"

namespace rakelight::cli {
namespace {

using json = nlohmann::ordered_json;

constexpr int kDevice = 4;

/// Lamp ids by chip path and offset, and what went wrong with the first that has no line.
struct LampLines {
  std::map<std::pair<std::string, unsigned>, std::string> ids;
  std::exception_ptr missing;

  std::string at(const GpioChip& chip, const GpioLineInfo& line) const {
    const auto found = ids.find({chip.path, line.offset});
    return found == ids.end() ? "" : found->second;
  }
};

LampLines lamp_lines(const Rig& rig, const std::vector<GpioChip>& chips) {
  LampLines lamps;
  const std::vector<GpioLine> lines = gpio_lines(rig);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    try {
      const FoundLine line = find_lines({lines[k]}, chips).front();
      lamps.ids[{line.chip_path, line.offset}] = rig.lamps[k].id;
    } catch (const std::system_error&) {
      if (!lamps.missing) lamps.missing = std::current_exception();
    }
  }
  return lamps;
}

const char* direction(const GpioLineInfo& line) { return line.output ? "output" : "input"; }

std::string holder(const GpioLineInfo& line) {
  if (!line.used) return "free";
  return "held by " + (line.consumer.empty() ? "the kernel" : line.consumer);
}

void print_text(const std::vector<GpioChip>& chips, const LampLines& lamps) {
  for (const GpioChip& chip : chips) {
    if (chip.fault) {
      std::printf("%s: cannot be read: %s\n", chip.name.c_str(), chip.fault.message().c_str());
      continue;
    }
    std::printf("%s (%s)\n", chip.name.c_str(), chip.label.c_str());
    for (const GpioLineInfo& line : chip.lines) {
      std::printf("  %3u  %-16s %-7s %-12s %-24s %s\n", line.offset,
                  line.name.empty() ? "-" : line.name.c_str(), direction(line),
                  line.active_low ? "active-low" : "active-high", holder(line).c_str(),
                  lamps.at(chip, line).c_str());
    }
  }
  if (chips.empty()) std::printf("no GPIO chip; is the lamp board plugged in?\n");
}

json lines_json(const GpioChip& chip, const LampLines& lamps) {
  json lines = json::array();
  for (const GpioLineInfo& line : chip.lines) {
    const std::string lamp = lamps.at(chip, line);
    lines.push_back({{"offset", line.offset},
                     {"name", line.name},
                     {"direction", direction(line)},
                     {"active_low", line.active_low},
                     {"used", line.used},
                     {"consumer", line.consumer},
                     {"lamp", lamp.empty() ? json() : json(lamp)}});
  }
  return lines;
}

void print_json(const std::vector<GpioChip>& chips, const LampLines& lamps) {
  json list = json::array();
  for (const GpioChip& chip : chips) {
    list.push_back({{"path", chip.path},
                    {"name", chip.name},
                    {"label", chip.label},
                    {"trouble", chip.fault ? json(chip.fault.message()) : json()},
                    {"lines", lines_json(chip, lamps)}});
  }
  std::cout << json{{"chips", list}}.dump(2, ' ', false, json::error_handler_t::replace) << "\n";
}

}  // namespace

std::string line_text(const LineAddress& line) {
  std::string text =
      line.name.empty() ? line.chip + " line " + std::to_string(line.offset) : "\"" + line.name + "\"";
  return line.active_low ? text + " (active low)" : text;
}

int list_lights(const Rig* rig, bool as_json) {
  const std::vector<GpioChip> chips = list_gpio_chips();
  const LampLines lamps = rig != nullptr ? lamp_lines(*rig, chips) : LampLines{};
  (as_json ? print_json : print_text)(chips, lamps);
  if (lamps.missing) std::rethrow_exception(lamps.missing);
  const bool unreadable =
      std::any_of(chips.begin(), chips.end(), [](const GpioChip& chip) { return !!chip.fault; });
  return unreadable ? kDevice : 0;
}

}  // namespace rakelight::cli
