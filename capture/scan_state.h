// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a scan has so far: enough to go on with after a break, and what is written as frames come.
#pragma once

#include <string>
#include <vector>

#include "capture/lamp_faults.h"
#include "capture/lit_check.h"
#include "capture/scan_plan.h"
#include "stack/stack.h"

namespace rakelight {

/// A stack that is being filled. A frame's index is its slot in the plan; further depth frames have higher indices.
struct ScanState {
  LightStack stack;
  LitSignatures signatures;
  std::vector<LampFault> faults;
  int repeats = 1;
  bool rgb_shot = false;

  bool has_slot(int slot) const;
};

/// The state beside the frames (signatures, faults, what was asked for), as JSON for the manifest's unknown keys.
std::string scan_keys(const ScanState& state);

/// Takes scan_keys out of stack.unknown_keys. @param subject for messages
/// @throws InputError if they are not there or not whole
ScanState parse_scan_state(LightStack stack, const std::string& subject);

/// What a finished stack says of its scan, for the manifest's unknown keys: faults of lamps.
std::string finished_keys(const ScanState& state);

}  // namespace rakelight
