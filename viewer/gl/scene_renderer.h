// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws a scene as a look asks for.
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "viewer/gl/surface_buffers.h"
#include "viewer/look.h"
#include "viewer/orbit_camera.h"
#include "viewer/surfaces.h"

namespace rakelight {

enum class Detail {
  full,
  quick,  ///< large meshes thinned: for a picture that is soon followed by another
};

/// Lives in one current OpenGL context.
class SceneRenderer {
 public:
  /// The surfaces must outlive it.
  explicit SceneRenderer(Surfaces& surfaces);

  /// Fills the bound framebuffer's rectangle (lower left corner at its origin). @param size pixels
  void draw(const Look& look, const OrbitCamera& camera, const cv::Size& size, Detail detail = Detail::full);

 private:
  struct Uploaded {
    SurfaceBuffers buffers;
    std::pair<Coloring, int> paint;
  };
  const SurfaceBuffers& painted(LayerKind layer, const Look& look);
  void set_uniforms(const Look& look, const OrbitCamera& camera, const cv::Size& size);

  Surfaces& surfaces_;
  GlObject program_;
  std::map<LayerKind, Uploaded> uploaded_;
};

}  // namespace rakelight
