// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps that hang on lines of another bank: a lamp board is tried with the virtual sensor before there is a real one.
#pragma once

#include <memory>

#include "lights/lights.h"

namespace rakelight {

/// Each write goes to `lines`, and what is then read back from them to `lamps`: a line that is stuck leaves its lamp as
/// it was. Both banks are of one size. @throws std::invalid_argument otherwise
std::unique_ptr<LineBank> follow_lines(std::unique_ptr<LineBank> lines, std::unique_ptr<LineBank> lamps);

}  // namespace rakelight
