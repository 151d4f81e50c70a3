// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/open_rig.h"

#include <filesystem>

#include "capture/following_lamps.h"
#include "capture/oni_file.h"
#include "capture/openni_source.h"
#include "capture/replay_source.h"
#include "capture/rig_lights.h"
#include "capture/virtual_sensor.h"
#include "stack/stack_io.h"

namespace rakelight {

namespace {

std::unique_ptr<LineBank> open_bank(const Rig& rig) {
  if (!rig.virtual_rig) return open_rig_bank(rig);
  if (!rig.virtual_rig->lamps_on_lines) return open_virtual_bank(rig);
  std::unique_ptr<LineBank> lines = open_rig_bank(rig);  // first: the virtual lamps start threads
  return follow_lines(std::move(lines), open_virtual_bank(rig));
}

}  // namespace

std::unique_ptr<Lights> open_lights(const Rig& rig) {
  std::vector<std::string> ids;
  for (const RigLamp& lamp : rig.lamps) ids.push_back(lamp.id);
  LightsOptions options;
  options.max_on = std::chrono::milliseconds(rig.max_on_ms);
  return std::make_unique<Lights>(std::move(ids), open_bank(rig), options);
}

bool is_recording(const Rig& rig) {
  const std::filesystem::path place = rig.sensor.uri;
  return !rig.virtual_rig && (place.extension() == ".oni" || std::filesystem::is_directory(place));
}

std::unique_ptr<FrameSource> open_frame_source(const Rig& rig) {
  if (!is_recording(rig)) return open_openni_source(rig);
  const std::filesystem::path place = rig.sensor.uri;
  return open_replay_source(place.extension() == ".oni" ? import_oni(place, {}) : read_stack(place));
}

}  // namespace rakelight
