// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One picture of each step of a scan, and what they show together: where the object is, what each lamp does.
#pragma once

#include <map>
#include <vector>

#include "capture/coarse_scene.h"
#include "capture/lamp_faults.h"
#include "capture/metering.h"
#include "capture/scan_state.h"

namespace rakelight {

/// By step of the plan; step 0 is the dark.
using StepPictures = std::map<std::size_t, Frame>;

struct SceneInPictures {
  CoarseScene scene;
  cv::Mat1b object;  ///< its cells; all where it cannot be told
};

/// @param header cameras, units and colour response
SceneInPictures examine(const LightStack& header, const StepPictures& pictures);

Brightness brightness_of(const SceneInPictures& seen, const StepPictures& pictures,
                         const ColorResponse& response);

/// Puts into `state` what each light looks like and which lamps do not work.
void learn_lamps(const SceneInPictures& seen, const StepPictures& pictures, const std::vector<RigLamp>& lamps,
                 ScanState& state);

}  // namespace rakelight
