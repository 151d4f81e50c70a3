// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The example file of the virtual rig with small pictures, so that rendering and refining take no time.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/file_edits.h"
#include "tests/support/temporary_folder.h"

namespace rakelight::test {

/// Writes home/rig.toml. @return its path
inline std::filesystem::path small_virtual_rig(const TemporaryFolder& home) {
  const std::filesystem::path rig = home / "rig.toml";
  set_text(rig, text_of(std::filesystem::path(RAKELIGHT_SOURCE_DIR) / "hw/rigs/virtual.toml"));
  for (const std::string stream : {"color", "depth"})
    replace_in_file(rig, stream + " = { width = 640, height = 480",
                    stream + " = { width = 320, height = 240");
  return rig;
}

}  // namespace rakelight::test
