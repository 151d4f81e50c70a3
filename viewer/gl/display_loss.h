// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The X server that goes away under a running program: closed, crashed, or a remote display whose line broke.
#pragma once

namespace rakelight {

/// From now on the loss of the display of GLFW's window is noted. Xlib itself would end the program by exit(), with other
/// threads still at work on what exit() takes apart.
void watch_for_display_loss();

/// @throws std::system_error if the display is lost
void require_display();

}  // namespace rakelight
