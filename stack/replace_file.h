// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One file changed in place so that a reader, or a crash, sees the old one or the new one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace rakelight {

/// Reads a file, gives its text to `edit` and puts what that returns in its place; a text that is the same is not
/// written. The file is locked meanwhile, links are followed, its permissions stay.
/// @throws what `edit` throws; InputError if it cannot be read or is larger than `max_bytes`; BusyError while another
///         program edits it; IoError.
void edit_file(const std::filesystem::path& file, std::uint64_t max_bytes,
               const std::function<std::string(const std::string&)>& edit);

}  // namespace rakelight
