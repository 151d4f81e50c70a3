// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// stack.json: everything of a light stack but its pixels (docs/stack-format.md).
#pragma once

#include <string>
#include <vector>

#include "stack/stack.h"

namespace rakelight {

/// The image files of one frame, relative to the stack folder; empty: none.
struct FrameFiles {
  std::string color, depth;
};

/// A stack without pixels, and for each frame the files that hold them.
struct Manifest {
  LightStack stack;
  std::vector<FrameFiles> files;
};

/// @param file named in messages  @throws InputError naming the key, the fault and the cure.
Manifest parse_manifest(const std::string& text, const std::string& file);

/// The text parse_manifest reads back to the same. `files` has one entry a frame. @throws InputError if the stack's
/// fields are not ones a manifest may hold (a negative focal length, two lights of one id, ...).
std::string manifest_text(const LightStack& stack, const std::vector<FrameFiles>& files);

/// The colour to_string names so. @throws InputError naming `place`.
LampColor parse_lamp_color(const std::string& text, const std::string& place);

}  // namespace rakelight
