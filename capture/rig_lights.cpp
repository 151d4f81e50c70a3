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
  if (rig.virtual_rig && !rig.virtual_rig->lamps_on_lines)
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

std::unique_ptr<LineBank> open_rig_bank(const Rig& rig) {
  GpioBankOptions options;
  options.max_on = std::chrono::milliseconds(rig.max_on_ms) + kGuardMargin;
  return open_gpio_bank(gpio_lines(rig), options);
}

}  // namespace rakelight
