// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/legend.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cstdio>

#include "viewer/window/font.h"

namespace rakelight {
namespace {

ImU32 im_color(const cv::Vec3b& color) { return IM_COL32(color[0], color[1], color[2], 255); }

ImU32 text_color(Background background) {
  return background == Background::white ? IM_COL32(20, 20, 20, 255) : IM_COL32(235, 235, 235, 255);
}

/// A translucent plate, so that words read over any surface.
void draw_plate(Background background, const ImVec2& low, const ImVec2& high) {
  const ImU32 color =
      background == Background::white ? IM_COL32(255, 255, 255, 200) : IM_COL32(20, 21, 24, 190);
  ImGui::GetBackgroundDrawList()->AddRectFilled(low, high, color, 4);
}

std::string tick_text(const ColorRange& range, double value) {
  char text[32];
  std::snprintf(text, sizeof text, range.scale == ColorScale::signed_ && value != 0 ? "%+.4g" : "%.4g",
                value);
  return text;
}

/// A bar at the lower right: title above, ticks below.
void draw_scale_bar(const ColorRange& range, Background background, const cv::Size2f& size) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float line = ImGui::GetFontSize(), width = std::min(22 * line, 0.6f * size.width),
              height = 0.9f * line;
  const float left = size.width - width - 2 * line, top = size.height - 2.9f * line;
  draw_plate(background, {left - 1.2f * line, top - 1.6f * line},
             {size.width - 0.8f * line, size.height - 0.4f * line});
  constexpr int kSteps = 128;
  for (int i = 0; i < kSteps; ++i) {
    const double value = range.low + (range.high - range.low) * (i + 0.5) / kSteps;
    const float x = left + width * static_cast<float>(i) / kSteps;
    list.AddRectFilled({x, top}, {x + width / kSteps + 0.5f, top + height}, im_color(color_of(range, value)));
  }
  const ImU32 ink = text_color(background);
  list.AddRect({left, top}, {left + width, top + height}, ink);
  const std::string title = range.quantity + ", " + range.unit;
  list.AddText({left, top - 1.3f * line}, ink, title.c_str());
  for (const double value : ticks(range)) {
    const float x = left + width * static_cast<float>((value - range.low) / (range.high - range.low));
    const std::string text = tick_text(range, value);
    const float half = ImGui::CalcTextSize(text.c_str()).x / 2;
    list.AddLine({x, top + height}, {x, top + height + 0.25f * line}, ink);
    list.AddText({x - half, top + height + 0.3f * line}, ink, text.c_str());
  }
}

std::string caption_of(LayerKind kind) {
  switch (kind) {
    case LayerKind::sensor:
      return "sensor";
    case LayerKind::preprocessed:
      return "sensor, filled and smoothed";
    case LayerKind::refined:
      return "refined";
    case LayerKind::truth:
      return "truth";
  }
  return "";
}

void draw_split(const Look& look, const cv::Size2f& size) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float line = ImGui::GetFontSize(), x = static_cast<float>(look.divider) * size.width;
  const ImU32 ink = text_color(look.background);
  list.AddLine({x, 0}, {x, size.height}, ink, 0.12f * line);
  const std::string before = caption_of(look.before), after = caption_of(look.layer);
  const float y = 0.8f * line;
  const float left = x - line - ImGui::CalcTextSize(before.c_str()).x, right = x + line;
  for (const auto& [start, text] : {std::pair(left, before), std::pair(right, after)}) {
    const float end = start + ImGui::CalcTextSize(text.c_str()).x;
    draw_plate(look.background, {start - 0.4f * line, y - 0.2f * line}, {end + 0.4f * line, y + 1.3f * line});
    list.AddText({start, y}, ink, text.c_str());
  }
}

}  // namespace

void draw_legend(const std::optional<ColorRange>& range, const Look& look, const cv::Size2f& size) {
  if (look.split) draw_split(look, size);
  if (range) draw_scale_bar(*range, look.background, size);
}

OffscreenLegend::OffscreenLegend() {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

OffscreenLegend::~OffscreenLegend() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void OffscreenLegend::draw(const std::optional<ColorRange>& range, const Look& look,
                           const cv::Size& size) const {
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  if (io.Fonts->Fonts.empty()) load_font(static_cast<float>(std::max(13, size.height / 48)));
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  draw_legend(range, look, cv::Size2f(size));
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace rakelight
