// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/rig.h"

#include <cstdio>

namespace rakelight {

Rig virtual_rig() {
  Rig rig;
  rig.sensor.uri = "virtual";
  rig.rgb_shot = true;
  rig.virtual_rig.emplace();
  constexpr int kWhiteLamps = 12;
  for (int k = 0; k < kWhiteLamps; ++k) {
    char id[16];
    std::snprintf(id, sizeof id, "white-%02d", k);
    rig.lamps.push_back({id, LampColor::white, {}, {}});
  }
  for (const LampColor color : {LampColor::red, LampColor::green, LampColor::blue}) {
    rig.lamps.push_back({to_string(color), color, {}, {}});
  }
  for (std::size_t k = 0; k < rig.lamps.size(); ++k) {
    rig.lamps[k].line.chip = "virtual";
    rig.lamps[k].line.offset = static_cast<unsigned>(k);
  }
  return rig;
}

}  // namespace rakelight
