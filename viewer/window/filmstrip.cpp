// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/filmstrip.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "viewer/commands.h"

namespace rakelight {
namespace {

constexpr int kThumbnailHeight = 160;  ///< pixels

cv::Mat3b thumbnail(const cv::Mat3b& picture) {
  cv::Mat3b small;
  const double scale = static_cast<double>(kThumbnailHeight) / picture.rows;
  cv::resize(picture, small, {}, scale, scale, cv::INTER_AREA);
  return small;
}

}  // namespace

PictureTexture::PictureTexture(const cv::Mat3b& picture)
    : texture_(make_texture()), aspect_(static_cast<float>(picture.cols) / static_cast<float>(picture.rows)) {
  const cv::Mat3b packed = picture.isContinuous() ? picture : picture.clone();
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, packed.cols, packed.rows, 0, GL_RGB, GL_UNSIGNED_BYTE, packed.data);
}

void* PictureTexture::handle() const {
  return reinterpret_cast<void*>(static_cast<std::uintptr_t>(texture_.id()));
}

void Filmstrip::draw(ViewState& state, const Scene& scene) {
  const float line = ImGui::GetFontSize(), height = 6 * line;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({14.5f * line, size.y - height - 4 * line}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({size.x - 15 * line, height + 3.4f * line}, ImGuiCond_FirstUseEver);
  ImGui::Begin("Images", &state.show_frames,
               ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_NoFocusOnAppearing);
  if (scene.frames.empty()) ImGui::TextUnformatted("no images here: the scan of this result is not at hand; start with --stack STACK");
  while (thumbnails_.size() < scene.frames.size())
    thumbnails_.emplace_back(thumbnail(scene.frames[thumbnails_.size()].picture));
  for (std::size_t i = 0; i < scene.frames.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));
    const bool shown = state.look.coloring == Coloring::image && state.look.image == static_cast<int>(i);
    const ImVec4 frame = shown ? ImVec4(1, 0.8f, 0.3f, 1) : ImVec4(0, 0, 0, 0);
    if (ImGui::ImageButton(thumbnails_[i].handle(), {height * thumbnails_[i].aspect(), height}, {0, 0},
                           {1, 1}, 3, frame)) {
      color_by(state, scene, Coloring::image);
      state.look.image = static_cast<int>(i);
      state.status = "image " + std::to_string(i) + ": " + scene.frames[i].caption;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", scene.frames[i].caption.c_str());
    ImGui::PopID();
  }
  ImGui::End();
}

}  // namespace rakelight
