// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ways to spoil a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace rakelight::test {

std::string text_of(const std::filesystem::path& file);
void set_text(const std::filesystem::path& file, const std::string& text);

/// Replaces the first occurrence; throws if there is none.
void replace_in_file(const std::filesystem::path& file, const std::string& from, const std::string& to);

/// A PNG of a few bytes whose valid header claims width x height 16-bit RGB pixels.
void write_png_bomb(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height);

}  // namespace rakelight::test
