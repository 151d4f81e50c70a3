// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pass over all lamps before a scan: it finds the exposure and learns the lamps.
#pragma once

#include "capture/scan_session.h"

namespace rakelight {

/// Changes the exposure until it is right (metering.h), then learns what each lamp looks like and which do not work.
/// @throws as capture_stack
void meter(ScanSession& session);

}  // namespace rakelight
