// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The result folder (docs/result-format.md).
#pragma once

#include <filesystem>

#include "refine/refine.h"

namespace rakelight {

/// Writes depth, normals, albedo, mesh.ply and result.json whole or not at all: a temporary sibling is filled under
/// a lock, then renamed. @throws BusyError, IoError; InputError if `folder` exists and is not a result.
void write_result(const RefineResult& result, const std::filesystem::path& folder);

/// Refuses early what write_result would refuse, so that a long run does not end in vain. @throws as write_result.
void check_result_folder(const std::filesystem::path& folder);

}  // namespace rakelight
