// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene.h"

#include <algorithm>

namespace rakelight {

const Layer* Scene::find(LayerKind kind) const {
  const auto found =
      std::find_if(layers.begin(), layers.end(), [kind](const Layer& layer) { return layer.kind == kind; });
  return found == layers.end() ? nullptr : &*found;
}

}  // namespace rakelight
