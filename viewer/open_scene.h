// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From folders to a scene.
#pragma once

#include <filesystem>

#include "viewer/scene.h"

namespace rakelight {

struct SceneSource {
  std::filesystem::path folder;  ///< a stack, a source folder of an importer's layout, or a result
  std::filesystem::path
      stack;  ///< with a result: the scan it was made from, for images, raw depth and truth; or empty
};

/// Reads what can be shown. A result names its scan, which takes longer to read and is left to with_stack(). @throws InputError naming the file, the fault and the cure; IoError.
Scene open_scene(const SceneSource& source);

/// The scene with what its `stack` holds: images, raw depth, truth; it is as it was where that cannot be read.
Scene with_stack(const Scene& scene);

/// A stack that is in memory. @param truth may be null
Scene scene_of(const LightStack& stack, const GroundTruth* truth);

}  // namespace rakelight
