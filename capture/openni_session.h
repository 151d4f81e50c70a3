// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenNI2 loaded until the program ends, and its errors as ours.
//
// It is not shut down and started anew for each device: for every new thread, the library asks pthread_kill whether the
// threads it has seen before are still alive, and dies when one's stack is gone. Each shutdown ends its drivers' threads,
// more than the C library keeps stacks for.
#pragma once

#include <string>
#include <system_error>

namespace rakelight {

/// Starts the library unless it runs. @throws std::system_error if it does not start.
void require_openni();

/// One line: what was attempted, what the library says, what to do.
std::system_error openni_error(std::errc code, const std::string& attempt, const std::string& cure);

}  // namespace rakelight
