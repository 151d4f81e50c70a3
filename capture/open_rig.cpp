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

std::unique_ptr<FrameSource> open_frame_source(const Rig& rig) {
  const std::filesystem::path recording = rig.sensor.uri;
  if (!rig.virtual_rig && recording.extension() == ".oni")
    return open_replay_source(import_oni(recording, {}));
  if (!rig.virtual_rig && std::filesystem::is_directory(recording))
    return open_replay_source(read_stack(recording));
  return open_openni_source(rig);
}

}  // namespace rakelight
