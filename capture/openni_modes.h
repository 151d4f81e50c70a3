// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Modes of OpenNI2 streams: chosen, never left to the device. For files that include OpenNI.h already.
#pragma once

#include <OpenNI.h>

#include "capture/rig.h"

namespace rakelight {

/// Creates the stream and sets the asked mode: RGB888, or the finest depth unit there is.
/// @throws std::system_error listing the modes of the device.
void create_stream(openni::Device& device, openni::SensorType type, const StreamMode& wanted,
                   openni::VideoStream& stream);

/// Metres a raw depth step. @throws std::system_error for formats that are no depth.
double depth_unit_m(openni::PixelFormat format);

/// Pinhole camera of the field of view that the stream tells; the device knows no more.
Camera nominal_camera(const openni::VideoStream& stream);

}  // namespace rakelight
