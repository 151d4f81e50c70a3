// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The truth/ folder beside a stack. Reading is read_truth of stack_io.h.
#pragma once

#include "stack/stack_io.h"

namespace rakelight {

/// Whether `folder` has a truth/.
bool has_truth(const std::filesystem::path& folder);

/// Fills an existing folder: depth.tiff, normals.tiff, and albedo.tiff and lamps.json where known. @throws IoError.
void write_truth(const GroundTruth& truth, const std::filesystem::path& folder);

}  // namespace rakelight
