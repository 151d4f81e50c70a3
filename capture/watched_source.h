// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame source that somebody looks at while it is used.
#pragma once

#include <functional>
#include <memory>

#include "capture/frame_source.h"

namespace rakelight {

/// Called in the thread that takes the frames, before it gets the frame; must not take long.
using FrameLook = std::function<void(Stream, const SensorFrame&)>;

/// The same source; `look` sees every frame that is taken from it.
std::unique_ptr<FrameSource> watched(std::unique_ptr<FrameSource> source, FrameLook look);

}  // namespace rakelight
