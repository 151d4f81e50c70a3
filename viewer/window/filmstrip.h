// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The scan's images in a row; a click colours the surface by one.
#pragma once

#include <vector>

#include "viewer/gl/gl_object.h"
#include "viewer/view_state.h"

namespace rakelight {

/// A picture in the graphics card's memory.
class PictureTexture {
 public:
  explicit PictureTexture(const cv::Mat3b& picture);
  void* handle() const;  ///< as Dear ImGui wants it
  float aspect() const { return aspect_; }

 private:
  GlObject texture_;
  float aspect_ = 1;
};

class Filmstrip {
 public:
  void draw(ViewState& state, const Scene& scene);

 private:
  std::vector<PictureTexture> thumbnails_;  ///< of the scene, made when first seen
};

}  // namespace rakelight
