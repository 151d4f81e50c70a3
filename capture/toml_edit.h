// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes single values in the text of a TOML file, so that comments, order and layout stay as somebody wrote them.
#pragma once

#include <string>

namespace rakelight {

/// The text with `key` of `table` set to `value` (TOML). An existing value is replaced where it stands; a missing key
/// is added after the last one of its table; a missing table at the end of the file.
/// @param table path as toml++ writes it: "sensor", "lamps[2]"; tables inside lists must exist
/// @param file for messages  @throws InputError if the text is no TOML or the table is no table
std::string with_toml_value(const std::string& text, const std::string& table, const std::string& key,
                            const std::string& value, const std::string& file);

}  // namespace rakelight
