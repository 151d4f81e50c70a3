// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/live_pictures.h"

#include <imgui.h>

#include <algorithm>

namespace rakelight {
namespace {

/// As large as fits the box from (x, 0), in its middle.
void draw_in(const PictureTexture& picture, float x, const cv::Size2f& box) {
  const float width = std::min(box.width, box.height * picture.aspect()), height = width / picture.aspect();
  const ImVec2 low(x + (box.width - width) / 2, (box.height - height) / 2);
  ImGui::GetBackgroundDrawList()->AddImage(picture.handle(), low, {low.x + width, low.y + height});
}

}  // namespace

void LivePictures::set(const cv::Mat3b& color, const cv::Mat3b& depth) {
  if (!color.empty()) color_.emplace(color);
  if (!depth.empty()) depth_.emplace(depth);
}

void LivePictures::draw(const cv::Size2f& size) const {
  const cv::Size2f half(size.width / 2, size.height);
  if (color_) draw_in(*color_, 0, half);
  if (depth_) draw_in(*depth_, half.width, half);
}

}  // namespace rakelight
