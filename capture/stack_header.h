// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a scan's stack says before it has frames.
#pragma once

#include "capture/frame_source.h"
#include "capture/rig.h"
#include "capture/scan_plan.h"

namespace rakelight {

/// Sensor and cameras as the source tells them; the rig's calibration wins over what the device supposes.
LightStack stack_header(const SourceDescription& source, const Rig& rig, const ScanPlan& plan);

}  // namespace rakelight
