// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surfaces of a scene, each built when it is first looked at.
#pragma once

#include <map>

#include "viewer/surface.h"

namespace rakelight {

class Surfaces {
 public:
  /// The scene must outlive it.
  explicit Surfaces(const Scene& scene) : scene_(scene) {}
  const Scene& scene() const { return scene_; }

  /// @param kind a layer the scene has  @throws InputError as surface_of
  const Surface& of(LayerKind kind);

  /// Of the layer that shows the object best: the refined one, else the first.
  Box bounds();

 private:
  const Scene& scene_;
  std::map<LayerKind, Surface> surfaces_;
};

}  // namespace rakelight
