// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surfaces and scale bars of a scene, each made when it is first looked at.
#pragma once

#include <map>
#include <optional>

#include "viewer/coloring.h"
#include "viewer/surface.h"

namespace rakelight {

class Surfaces {
 public:
  /// The scene must outlive it.
  explicit Surfaces(const Scene& scene) : scene_(scene) {}
  const Scene& scene() const { return scene_; }

  /// @param kind a layer the scene has  @throws InputError as surface_of
  const Surface& of(LayerKind kind);

  /// The scale bar of a colouring, as range_of().
  const std::optional<ColorRange>& range(Coloring coloring);

  /// Of the layer that shows the object best: the refined one, else the first.
  Box bounds();

 private:
  const Scene& scene_;
  std::map<LayerKind, Surface> surfaces_;
  std::map<Coloring, std::optional<ColorRange>> ranges_;
};

}  // namespace rakelight
