// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The room's door: options out of range are refused before any work.
#pragma once

#include "simulate/options.h"

namespace rakelight {

/// @throws UsageError naming the option and its range.
void check_options(const SimulateOptions& options);

}  // namespace rakelight
