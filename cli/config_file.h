// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parameters from a TOML file.
#pragma once

#include <filesystem>
#include <optional>

#include "refine/options.h"

namespace rakelight::cli {

/// What the command line says about the preset; empty: the file, then the default.
struct PresetChoice {
  std::optional<Preset> preset;
  std::optional<Method> method;
};

/// The preset's defaults, changed by the file's values (an empty path: no file). The names are those of
/// `options` in result.json; groups are tables. @throws InputError naming file, line and key.
RefineOptions read_options(const std::filesystem::path& config, const PresetChoice& choice);

}  // namespace rakelight::cli
