// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The GPIO lines that a rig file names for its lamps.
#pragma once

#include <memory>
#include <vector>

#include "capture/rig.h"
#include "lights/gpio_bank.h"
#include "lights/lights.h"

namespace rakelight {

/// In the order of `rig.lamps`. @throws UsageError for virtual lamps and for a rig without any
std::vector<GpioLine> gpio_lines(const Rig& rig);

/// The same lines, requested and off; a guard switches off what is lit for longer than `rig.max_on_ms`. Call it before
/// starting threads. @throws as open_gpio_bank() and gpio_lines()
std::unique_ptr<LineBank> open_rig_bank(const Rig& rig);

}  // namespace rakelight
