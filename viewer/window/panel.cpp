// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/panel.h"

#include <imgui.h>

#include "viewer/coloring.h"
#include "viewer/commands.h"

namespace rakelight {
namespace {

constexpr float kWidth = 15.5f;  ///< of the panel, in letter heights

void choose_layer(ViewState& state, const Scene& scene) {
  for (const Layer& layer : scene.layers) {
    if (ImGui::RadioButton(name_of(kLayerNames, layer.kind).c_str(), state.look.layer == layer.kind))
      show_layer(state, scene, layer.kind);
  }
  ImGui::Checkbox("split with", &state.look.split);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (!ImGui::BeginCombo("##before", name_of(kLayerNames, state.look.before).c_str())) return;
  for (const Layer& layer : scene.layers) {
    if (ImGui::Selectable(name_of(kLayerNames, layer.kind).c_str(), state.look.before == layer.kind))
      state.look.before = layer.kind;
  }
  ImGui::EndCombo();
}

/// What is not there is greyed, with the reason as a hint.
void choose_coloring(ViewState& state, const Scene& scene) {
  for (const auto& [coloring, name] : kColoringNames) {
    const std::string why = obstacle(scene, coloring);
    ImGui::BeginDisabled(!why.empty());
    if (ImGui::RadioButton(name, state.look.coloring == coloring)) color_by(state, scene, coloring);
    ImGui::EndDisabled();
    if (!why.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", why.c_str());
  }
  if (state.look.coloring != Coloring::image) return;
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderInt("##image", &state.look.image, 0, static_cast<int>(scene.frames.size()) - 1,
                   scene.frames[static_cast<std::size_t>(state.look.image)].caption.c_str());
}

void choose_light(ViewState& state) {
  for (const auto& [material, name] : kMaterialNames) {
    if (ImGui::RadioButton(name, state.look.material == material)) state.look.material = material;
    if (material != kMaterialNames.back().value) ImGui::SameLine();
  }
  ImGui::Checkbox("light follows the mouse", &state.light_follows_mouse);
  float azimuth = static_cast<float>(state.look.light.azimuth_deg);
  float elevation = static_cast<float>(state.look.light.elevation_deg);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderFloat("##azimuth", &azimuth, -180, 180, "azimuth %.0f deg")) {
    state.look.light.azimuth_deg = static_cast<double>(azimuth);
    state.light_follows_mouse = false;
  }
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderFloat("##elevation", &elevation, 0, 90, "elevation %.0f deg")) {
    state.look.light.elevation_deg = static_cast<double>(elevation);
    state.light_follows_mouse = false;
  }
}

void take_tool(ViewState& state, const Scene& scene, const char* label, Tool tool, const char* key) {
  if (ImGui::RadioButton(label, state.tool == tool)) press_key(key, state, scene);
}

}  // namespace

void draw_panel(ViewState& state, const Scene& scene) {
  const float line = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({0.6f * line, 0.6f * line}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({kWidth * line, 0}, ImGuiCond_Always);
  ImGui::Begin("Rakelight", &state.show_panel,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted("Layer");
  choose_layer(state, scene);
  ImGui::Separator();
  ImGui::TextUnformatted("Colour");
  choose_coloring(state, scene);
  ImGui::Separator();
  ImGui::TextUnformatted("Light");
  choose_light(state);
  ImGui::Separator();
  take_tool(state, scene, "distance", Tool::distance, "D");
  ImGui::SameLine();
  take_tool(state, scene, "profile", Tool::profile, "P");
  ImGui::Checkbox("points", &state.look.points);
  ImGui::SameLine();
  ImGui::Checkbox("orthographic", &state.camera.orthographic);
  ImGui::TextDisabled("F1: keys");
  ImGui::End();
}

void draw_keys_page(ViewState& state) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::Begin("Keys", &state.show_keys, ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2)) {
    const auto row = [](const char* key, const char* does) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(does);
    };
    row("left drag", "turn");
    row("right, middle or Shift + left drag", "move");
    row("wheel", "zoom to the mouse");
    row("drop a folder", "open a scan or a result");
    for (const KeyCommand& command : key_commands()) row(command.key.c_str(), command.does.c_str());
    ImGui::EndTable();
  }
  ImGui::End();
}

void draw_status(const ViewState& state, const cv::Size2f& size) {
  if (state.status.empty()) return;
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const float line = ImGui::GetFontSize();
  const ImVec2 text = ImGui::CalcTextSize(state.status.c_str()), at(0.8f * line, size.height - 1.8f * line);
  list.AddRectFilled({at.x - 0.4f * line, at.y - 0.3f * line},
                     {at.x + text.x + 0.4f * line, at.y + 1.3f * line}, IM_COL32(20, 21, 24, 210), 4);
  list.AddText(at, IM_COL32(235, 235, 235, 255), state.status.c_str());
}

}  // namespace rakelight
