// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/marks.h"

#include <imgui.h>

#include <cstdio>
#include <optional>

namespace rakelight {
namespace {

constexpr ImU32 kInk = IM_COL32(255, 200, 70, 255), kEdge = IM_COL32(0, 0, 0, 200);

std::optional<ImVec2> on_screen(const ViewState& state, const Eigen::Vector3d& point,
                                const cv::Size2f& size) {
  const auto at = project(state.camera, state.aspect, point);
  if (!at) return std::nullopt;
  return ImVec2(static_cast<float>((at->x() + 1) / 2) * size.width,
                static_cast<float>((1 - at->y()) / 2) * size.height);
}

void draw_length(const ViewState& state, const ImVec2& a, const ImVec2& b) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  char text[48];
  std::snprintf(text, sizeof text, "%.2f mm", measured_mm(state));
  const float line = ImGui::GetFontSize();
  const ImVec2 at((a.x + b.x) / 2 + 0.6f * line, (a.y + b.y) / 2 + 0.4f * line),
      width = ImGui::CalcTextSize(text);
  list.AddRectFilled({at.x - 4, at.y - 2}, {at.x + width.x + 4, at.y + width.y + 2}, kEdge, 4);
  list.AddText(at, kInk, text);
}

}  // namespace

void draw_marks(const ViewState& state, const cv::Size2f& size) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float unit = ImGui::GetFontSize() / 15;
  std::vector<ImVec2> ends;
  for (const Eigen::Vector3d& point : state.points) {
    if (const auto at = on_screen(state, point, size)) ends.push_back(*at);
  }
  if (ends.size() == 2) {
    list.AddLine(ends[0], ends[1], kEdge, 4 * unit);
    list.AddLine(ends[0], ends[1], kInk, 2 * unit);
    draw_length(state, ends[0], ends[1]);
  }
  for (const ImVec2& end : ends) {
    list.AddCircleFilled(end, 5 * unit, kEdge);
    list.AddCircleFilled(end, 3.5f * unit, kInk);
  }
}

}  // namespace rakelight
