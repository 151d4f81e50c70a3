// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An OpenNI2 sensor, real or virtual, as a source of frames.
//
// Listeners feed queues, for OpenNI2 itself keeps one frame a stream. Every wait has an end: after an unplug the library reports
// no error, it only falls silent.
#pragma once

#include <memory>

#include "capture/frame_source.h"
#include "capture/rig.h"

namespace rakelight {

/// Opens the rig's sensor in the rig's modes; depth is registered to colour where the device can do it, unless the rig knows
/// T_color_depth of its own calibration. A device stamp is the time at which the frame's last row closed.
/// @throws std::system_error: no such sensor or driver, no permission, a mode that the sensor does not have (the message lists
/// those it has)
std::unique_ptr<FrameSource> open_openni_source(const Rig& rig);

}  // namespace rakelight
