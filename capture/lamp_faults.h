// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lamps that do not do what the rig file says, told from one picture of each: burnt out, stuck, dim, swapped.
#pragma once

#include <string>
#include <vector>

#include "capture/lamp_light.h"

namespace rakelight {

struct LampFault {
  enum class Kind { no_light, stuck_on, dim, swapped };
  Kind kind = Kind::no_light;
  std::string lamp;
  std::string other;    ///< swapped: with which
  double level = 0;     ///< light, as a share of what the other lamps lead to expect
  std::string message;  ///< one sentence with what to do
};
std::string to_string(LampFault::Kind kind);

std::vector<LampFault> find_lamp_faults(const std::vector<RigLamp>& lamps, const CoarseScene& scene,
                                        const LampPictures& pictures);

}  // namespace rakelight
