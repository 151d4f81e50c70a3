// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What runs in the guard process.
#pragma once

#include <chrono>
#include <vector>

#include "lights/lights.h"

namespace rakelight {

enum class GuardMessage : char { lit = 'L', dark = 'D', goodbye = 'G' };

/// Watches the program at the other end of `socket`. Writes "off" to every line of `bank` when the socket ends without
/// a goodbye, or when the last message is `lit` and older than `max_on`. Never returns.
/// @param keep descriptors to leave open
[[noreturn]] void run_guard(LineBank& bank, int socket, std::vector<int> keep,
                            std::chrono::milliseconds max_on);

}  // namespace rakelight
