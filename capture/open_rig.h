// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A rig's devices, real or virtual. Open the lamps first: those on GPIO fork a guard, which wants no threads yet.
#pragma once

#include <memory>

#include "capture/frame_source.h"
#include "capture/rig.h"
#include "lights/lights.h"

namespace rakelight {

/// All lamps of the rig, off, limited by `rig.max_on_ms`. @throws std::system_error
std::unique_ptr<Lights> open_lights(const Rig& rig);

/// Whether the rig's sensor is a recording, which does not follow lamps: an .oni file or a stack folder.
bool is_recording(const Rig& rig);

/// The sensor; where its URI is an .oni file or a stack folder, a replay of that. @throws std::system_error; InputError
std::unique_ptr<FrameSource> open_frame_source(const Rig& rig);

}  // namespace rakelight
