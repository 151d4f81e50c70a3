// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surfaces.h"

#include "viewer/look.h"

namespace rakelight {

const Surface& Surfaces::of(LayerKind kind) {
  const auto found = surfaces_.find(kind);
  if (found != surfaces_.end()) return found->second;
  const std::string subject = scene_.title + " (" + name_of(kLayerNames, kind) + " depth)";
  return surfaces_.emplace(kind, surface_of(*scene_.find(kind), subject)).first->second;
}

const std::optional<ColorRange>& Surfaces::range(Coloring coloring) {
  const auto found = ranges_.find(coloring);
  if (found != ranges_.end()) return found->second;
  return ranges_.emplace(coloring, range_of(scene_, coloring)).first->second;
}

Box Surfaces::bounds() {
  const bool refined = scene_.find(LayerKind::refined) != nullptr;
  return of(refined ? LayerKind::refined : scene_.layers.front().kind).bounds;
}

}  // namespace rakelight
