// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps go off even if the program can no longer do it: killed, crashed, stopped or stuck. A second process shares
// the lines and writes "off" then. It is no substitute for a one-shot in the lamp circuit (power may fail, too).
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "lights/lights.h"

namespace rakelight {

struct GuardOptions {
  /// The guard switches off what has been lit for longer without a new write (the program hangs or was stopped).
  std::chrono::milliseconds max_on{2500};
};

/// Opens a bank and forks its guard, which holds the same lines through the descriptors that `open` has left open, and
/// nothing else. Call it before the program starts threads. The guard ignores the terminal's signals and ends, at
/// the latest, with the program. @throws what `open` throws, std::system_error if there can be no guard
std::unique_ptr<LineBank> open_guarded(const std::function<std::unique_ptr<LineBank>()>& open,
                                       const GuardOptions& options = {});

}  // namespace rakelight
