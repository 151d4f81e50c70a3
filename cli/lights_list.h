// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `rakelight lights list`.
#pragma once

#include <string>

#include "capture/rig.h"

namespace rakelight::cli {

/// As a rig file says it: `"GPIO17"`, `cp2112_gpio line 3`, with `(active low)`.
std::string line_text(const LineAddress& line);

/// Prints all chips and lines. @param rig null: without lamps  @return exit code: 4 where a chip cannot be read
/// @throws std::system_error after printing, where a line of the rig is missing
int list_lights(const Rig* rig, bool as_json);

}  // namespace rakelight::cli
