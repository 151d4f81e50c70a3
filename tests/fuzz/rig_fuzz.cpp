// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any text is a rig or an InputError. What is read of a rig holds the promises that the rest of the program relies on.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>

#include "capture/rig_file.h"
#include "stack/errors.h"

namespace {

void require(bool promise) {
  if (!promise) std::abort();
}

void check(const rakelight::Rig& rig) {
  require(!rig.lamps.empty() && rig.max_on_ms > 0 && rig.repeats > 0);
  std::set<std::string> ids;
  for (const rakelight::RigLamp& lamp : rig.lamps) {
    require(!lamp.id.empty() && ids.insert(lamp.id).second);
    require(!lamp.position_m || lamp.position_m->allFinite());
  }
  require(rig.sensor.exposure_us > 0 && rig.sensor.gain >= 0 && rig.sensor.color.fps > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    check(rakelight::parse_rig(std::string(data, data + size), "rig.toml"));
  } catch (const rakelight::InputError&) {}
  return 0;
}
