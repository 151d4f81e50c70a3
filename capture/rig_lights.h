// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lamps of a rig, over the GPIO lines that its file names.
#pragma once

#include <memory>
#include <vector>

#include "capture/rig.h"
#include "lights/gpio_bank.h"
#include "lights/lights.h"

namespace rakelight {

/// In the order of `rig.lamps`.
std::vector<GpioLine> gpio_lines(const Rig& rig);

/// All lamps of the rig, off, limited by `rig.max_on_ms`. It forks a guard: call it before starting threads.
/// @throws std::system_error as open_gpio_bank(); UsageError for a virtual rig or one without lamps, which have no lines
std::unique_ptr<Lights> open_rig_lights(const Rig& rig);

}  // namespace rakelight
