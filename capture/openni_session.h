// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// OpenNI2 loaded for as long as something of ours needs it, and its errors as ours.
#pragma once

#include <string>
#include <system_error>

namespace rakelight {

class OpenniSession {
 public:
  /// @throws std::system_error if the library does not start.
  OpenniSession();
  ~OpenniSession();
  OpenniSession(const OpenniSession&) = delete;
  OpenniSession& operator=(const OpenniSession&) = delete;
};

/// One line: what was attempted, what the library says, what to do.
std::system_error openni_error(std::errc code, const std::string& attempt, const std::string& cure);

}  // namespace rakelight
