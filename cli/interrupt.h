// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ctrl-C and SIGTERM as a question that long work asks.
#pragma once

namespace rakelight::cli {

/// From now on the first SIGINT or SIGTERM is noted; a second one ends the program at once.
void catch_interrupts();

/// Whether one has come.
bool interrupted();

}  // namespace rakelight::cli
