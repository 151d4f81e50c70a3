// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keys by the names of viewer/commands.h.
#pragma once

#include <string>

namespace rakelight {

/// @param key, scancode as GLFW tells them; letters follow the keyboard's layout  @return empty for a key without a name
std::string key_name(int key, int scancode);

}  // namespace rakelight
