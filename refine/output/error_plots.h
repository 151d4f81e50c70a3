// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a result's errors look like before and after refinement, as figures for print.
#pragma once

#include <filesystem>

#include "refine/evaluate.h"

namespace rakelight {

/// Writes depth_error.png and normal_error.png (maps) and depth_histogram.png and normal_histogram.png, each with
/// the sensor's errors beside the refined ones, whole or not at all.
/// @throws BusyError, IoError; InputError if `folder` exists and is neither empty nor such a folder.
void write_error_plots(const ErrorMaps& before, const ErrorMaps& after, const std::filesystem::path& folder);

}  // namespace rakelight
