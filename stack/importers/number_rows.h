// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text files of numbers, as public data sets keep their cameras and lamps in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rakelight {

/// Rows of finite numbers separated by blanks, tabs or commas; empty lines are skipped.
/// @throws InputError naming the line that cannot be read.
std::vector<std::vector<double>> read_number_rows(const std::filesystem::path& file);

/// The same of text. @param file named in messages
std::vector<std::vector<double>> parse_number_rows(std::string_view text, const std::string& file);

}  // namespace rakelight
