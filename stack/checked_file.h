// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files read and written whole, every system call checked: what a stream would swallow becomes a typed error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rakelight {

using Bytes = std::vector<unsigned char>;

/// The first `count` bytes of a regular file, or all of it if it is shorter. @throws as read_file.
Bytes read_file_start(const std::filesystem::path& file, std::size_t count);

/// The bytes of a regular file. Pipes and devices are refused, so reading never hangs.
/// @throws InputError if it is missing, no regular file, unreadable or larger than `max_bytes`; IoError if the disk fails.
Bytes read_file(const std::filesystem::path& file, std::uint64_t max_bytes);

/// Writes a new file; AtomicFolder::commit waits until the disk has it.
/// @throws IoError (disk full, quota, read-only, I/O error).
void write_file(const std::filesystem::path& file, const void* data, std::size_t size);
void write_file(const std::filesystem::path& file, const std::string& text);

/// `relative` inside `folder`, following links only within it.
/// @throws InputError for absolute paths, `..`, control characters and links that lead out of the folder.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& relative);

/// What a failed system call on a path means: disk trouble. The message says why and what to do.
[[noreturn]] void throw_io_error(const std::string& action, const std::filesystem::path& path, int error);

}  // namespace rakelight
