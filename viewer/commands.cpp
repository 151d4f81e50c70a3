// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/commands.h"

#include <algorithm>

#include "viewer/coloring.h"

namespace rakelight {
namespace {

using Apply = std::function<void(ViewState&, const Scene&)>;

Apply layer(LayerKind kind) {
  return [kind](ViewState& state, const Scene& scene) { show_layer(state, scene, kind); };
}

Apply toggle(bool ViewState::*flag) {
  return [flag](ViewState& state, const Scene&) { state.*flag = !(state.*flag); };
}

Apply turn(StandardView view) {
  return [view](ViewState& state, const Scene&) {
    turn_to(state.camera, view);
    fit(state.camera, state.bounds, state.aspect);
  };
}

/// The next colouring, forwards or backwards, that the scene allows.
Apply step_coloring(int step) {
  return [step](ViewState& state, const Scene& scene) {
    const int count = static_cast<int>(kColoringNames.size());
    int index = static_cast<int>(state.look.coloring);
    do index = (index + step + count) % count;
    while (!obstacle(scene, kColoringNames[static_cast<std::size_t>(index)].value).empty());
    color_by(state, scene, kColoringNames[static_cast<std::size_t>(index)].value);
  };
}

Apply step_image(int step) {
  return [step](ViewState& state, const Scene& scene) {
    color_by(state, scene, Coloring::image);
    const int count = static_cast<int>(scene.frames.size());
    if (count == 0) return;
    state.look.image = (state.look.image + step + count) % count;
    state.status = "image " + std::to_string(state.look.image) + ": " +
                   scene.frames[static_cast<std::size_t>(state.look.image)].caption;
  };
}

Apply take(Tool tool, const char* status) {
  return [tool, status](ViewState& state, const Scene&) {
    state.tool = state.tool == tool ? Tool::none : tool;
    state.points.clear();
    state.status = state.tool == tool ? status : "";
  };
}

void next_material(ViewState& state, const Scene&) {
  const auto next = (static_cast<std::size_t>(state.look.material) + 1) % kMaterialNames.size();
  state.look.material = kMaterialNames[next].value;
}

void put_down(ViewState& state, const Scene&) {
  state.tool = Tool::none;
  state.points.clear();
  state.status.clear();
  state.show_keys = false;
}

std::vector<KeyCommand> make_commands() {
  return {
      {"1", "layer: the sensor's depth, frames merged", layer(LayerKind::sensor)},
      {"2", "layer: the sensor's depth, filled and smoothed", layer(LayerKind::preprocessed)},
      {"3", "layer: refined", layer(LayerKind::refined)},
      {"4", "layer: the truth", layer(LayerKind::truth)},
      {"S", "split before | after; drag the divider",
       [](auto& state, auto&) { state.look.split = !state.look.split; }},
      {"C", "next colouring", step_coloring(1)},
      {"V", "previous colouring", step_coloring(-1)},
      {"]", "colour by the next image", step_image(1)},
      {"[", "colour by the previous image", step_image(-1)},
      {"M", "material: matte, clay, chrome", next_material},
      {"L", "the light follows the mouse, or stays", toggle(&ViewState::light_follows_mouse)},
      {"X", "points or mesh", [](auto& state, auto&) { state.look.points = !state.look.points; }},
      {"B", "dark or white background",
       [](auto& state, auto&) {
         const bool dark = state.look.background == Background::dark;
         state.look.background = dark ? Background::white : Background::dark;
       }},
      {"D", "measure a distance: click two points", take(Tool::distance, "distance: click two points")},
      {"P", "cut a profile: click two points", take(Tool::profile, "profile: click two points")},
      {"Escape", "put the tool down", put_down},
      {"F", "fit", [](auto& state, auto&) { fit(state.camera, state.bounds, state.aspect); }},
      {"O", "perspective or orthographic",
       [](auto& state, auto&) { state.camera.orthographic = !state.camera.orthographic; }},
      {"F2", "view: front", turn(StandardView::front)},
      {"F3", "view: back", turn(StandardView::back)},
      {"F4", "view: left", turn(StandardView::left)},
      {"F5", "view: right", turn(StandardView::right)},
      {"F6", "view: top", turn(StandardView::top)},
      {"F7", "view: bottom", turn(StandardView::bottom)},
      {"T", "the scan's images", toggle(&ViewState::show_frames)},
      {"E", "how the refinement converged", toggle(&ViewState::show_convergence)},
      {"Tab", "panel on or off", toggle(&ViewState::show_panel)},
      {"F12", "screenshot, into the current folder", [](auto& state, auto&) { state.wants_picture = true; }},
      {"F1", "this page", toggle(&ViewState::show_keys)},
      {"Q", "quit", [](auto& state, auto&) { state.wants_quit = true; }},
  };
}

}  // namespace

const std::vector<KeyCommand>& key_commands() {
  static const std::vector<KeyCommand> commands = make_commands();
  return commands;
}

bool press_key(const std::string& key, ViewState& state, const Scene& scene) {
  const auto& commands = key_commands();
  const auto found =
      std::find_if(commands.begin(), commands.end(), [&](const auto& c) { return c.key == key; });
  if (found == commands.end()) return false;
  found->apply(state, scene);
  return true;
}

void show_layer(ViewState& state, const Scene& scene, LayerKind layer) {
  const bool there = scene.find(layer) != nullptr;
  if (there) state.look.layer = layer;
  const std::string name = name_of(kLayerNames, layer);
  const bool of_scan = layer == LayerKind::sensor || layer == LayerKind::truth;
  state.status = there     ? "layer: " + name
                 : of_scan ? "no layer " + name + " here; start with --stack STACK"
                           : "no layer " + name + " here; open a result of refine";
}

void color_by(ViewState& state, const Scene& scene, Coloring coloring) {
  const std::string why = obstacle(scene, coloring);
  if (why.empty()) state.look.coloring = coloring;
  state.status = why.empty() ? "colour: " + name_of(kColoringNames, coloring) : why;
}

}  // namespace rakelight
