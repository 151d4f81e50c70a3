// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/rig_lights.h"

#include "stack/errors.h"

namespace rakelight {
namespace {

/// The watchdog of the program itself comes first.
constexpr std::chrono::milliseconds kGuardMargin{500};

}  // namespace

std::vector<GpioLine> gpio_lines(const Rig& rig) {
  if (rig.virtual_rig)
    throw UsageError("the lamps of \"" + rig.name +
                     "\" are virtual: no line switches them; give --rig FILE of a real rig");
  if (rig.lamps.empty())
    throw UsageError("the rig \"" + rig.name + "\" has no lamps; add [[lamps]] to its file");
  std::vector<GpioLine> lines;
  lines.reserve(rig.lamps.size());
  for (const RigLamp& lamp : rig.lamps)
    lines.push_back({lamp.line.name, lamp.line.chip, lamp.line.offset, lamp.line.active_low});
  return lines;
}

std::unique_ptr<Lights> open_rig_lights(const Rig& rig) {
  LightsOptions options;
  options.max_on = std::chrono::milliseconds(rig.max_on_ms);
  GpioBankOptions bank;
  bank.max_on = options.max_on + kGuardMargin;
  std::vector<std::string> ids;
  ids.reserve(rig.lamps.size());
  for (const RigLamp& lamp : rig.lamps) ids.push_back(lamp.id);
  return std::make_unique<Lights>(std::move(ids), open_gpio_bank(gpio_lines(rig), bank), options);
}

}  // namespace rakelight
