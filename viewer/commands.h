// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the keys do: one table for the window and its keys page.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "viewer/view_state.h"

namespace rakelight {

struct KeyCommand {
  std::string key;   ///< as printed on it: "A", "1", "[", "Tab", "F1"
  std::string does;  ///< for the keys page
  std::function<void(ViewState&, const Scene&)> apply;
};

/// In the order of the keys page.
const std::vector<KeyCommand>& key_commands();

/// Does what the key is for. @return false for a key without a command
bool press_key(const std::string& key, ViewState& state, const Scene& scene);

/// Shows a layer, or says in the status what is missing.
void show_layer(ViewState& state, const Scene& scene, LayerKind layer);

/// Colours so, or says in the status what is missing.
void color_by(ViewState& state, const Scene& scene, Coloring coloring);

}  // namespace rakelight
