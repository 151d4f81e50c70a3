// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A recorded stack as a source of frames: in the order of the stack, as fast as they are taken.
#pragma once

#include <memory>

#include "capture/frame_source.h"

namespace rakelight {

/// Stamps are the stack's, or a period of 33.3 ms where it has none. After the last frame next() gives nothing.
std::unique_ptr<FrameSource> open_replay_source(LightStack stack);

}  // namespace rakelight
