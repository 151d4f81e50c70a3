// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stack folder, format version 1 (docs/stack-format.md).
#pragma once

#include <filesystem>
#include <optional>

#include "stack/stack.h"

namespace rakelight {

/// Reads a stack folder, or a source folder of a known importer's layout (imported on the fly).
/// Every header is checked before pixels are allocated; paths may not leave the folder.
/// @param colors on_disk: Frame::read_color instead of Frame::color, as far as the layout allows it. The images are then
///               checked when they are read.
/// @throws InputError naming the file, the fault and the cure; IoError when the disk fails.
LightStack read_stack(const std::filesystem::path& folder, Colors colors = Colors::in_memory);

/// Reads a mask image (255 = object). @throws InputError as read_stack.
cv::Mat1b read_mask(const std::filesystem::path& file);

/// Writes a stack folder whole or not at all: a temporary sibling is filled, then renamed.
/// `truth` (if any) goes to truth/. @throws IoError, BusyError; InputError if `folder` exists and is not a stack.
void write_stack(const LightStack& stack, const std::filesystem::path& folder,
                 const std::optional<GroundTruth>& truth = std::nullopt);

/// Refuses early what write_stack would refuse, so that a long run does not end in vain. @throws as write_stack.
void check_stack_folder(const std::filesystem::path& folder);

/// Reads truth/ beside a stack (or a folder that holds depth.tiff and normals.tiff itself).
/// @throws InputError if it is missing or malformed.
GroundTruth read_truth(const std::filesystem::path& folder);

}  // namespace rakelight
