// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rig does not do what it must: named in one line with what to do.
#pragma once

#include <stdexcept>

namespace rakelight {

/// A device answers but does not do its work: lamps without effect, an object that has moved. Exit code 4.
class DeviceFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace rakelight
