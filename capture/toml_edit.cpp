// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/toml_edit.h"

#include "capture/toml_reader.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

/// Byte offset of a position: toml++ counts lines and, in them, code points, both from 1.
std::size_t offset_of(const std::string& text, const toml::source_position& at) {
  std::size_t offset = 0;
  for (toml::source_index line = 1; line < at.line; ++line) offset = text.find('\n', offset) + 1;
  for (toml::source_index column = 1; column < at.column && offset < text.size(); ++column) {
    ++offset;
    while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0) == 0x80) ++offset;
  }
  return offset;
}

std::size_t end_of_line(const std::string& text, std::size_t offset) {
  const std::size_t end = text.find('\n', offset);
  return end == std::string::npos ? text.size() : end;
}

/// Where the last thing that belongs to a table's own body ends (tables with headers of their own do not).
toml::source_position end_of_body(const toml::table& table) {
  toml::source_position end = table.source().end;
  for (const auto& [key, node] : table) {
    const bool own_header = (node.is_table() && !node.as_table()->is_inline()) || node.is_array_of_tables();
    if (!own_header && end < node.source().end) end = node.source().end;
  }
  return end;
}

/// Adds a line after the last of a table's body; after a bare header, below the comments that explain it.
std::string add_line(std::string text, const toml::table& table, const std::string& line) {
  std::size_t end = end_of_line(text, offset_of(text, end_of_body(table)));
  while (table.empty() && end + 1 < text.size() && text[end + 1] == '#') end = end_of_line(text, end + 1);
  return text.insert(end, "\n" + line);
}

std::string add_inline(std::string text, const toml::table& table, const std::string& entry) {
  const std::size_t brace = offset_of(text, table.source().end) - 1;  // of the closing one
  std::size_t at = brace;
  while (at > 0 && text[at - 1] == ' ') --at;
  return text.insert(at, (table.empty() ? " " : ", ") + entry + (at == brace ? " " : ""));
}

/// A table that has no header of its own is where its first child's header is.
bool has_header(const toml::table& table) {
  for (const auto& [key, node] : table) {
    if (node.is_table() && !node.as_table()->is_inline() && node.source().begin == table.source().begin)
      return false;
  }
  return true;
}

std::string add_table(std::string text, const std::string& table, const std::string& entry) {
  if (!text.empty() && text.back() != '\n') text += '\n';
  return text + (text.empty() ? "" : "\n") + "[" + table + "]\n" + entry + "\n";
}

}  // namespace

std::string with_toml_value(const std::string& text, const std::string& table, const std::string& key,
                            const std::string& value, const std::string& file) {
  const toml::table root = parse_toml(text, file);
  const auto node = root.at_path(table);
  const std::string entry = key + " = " + value;
  const toml::table* found = node.as_table();
  if (!node || (found != nullptr && !has_header(*found))) return add_table(text, table, entry);
  if (found == nullptr) throw InputError(file, "'" + table + "' is no table", "write [" + table + "]");
  if (const toml::node* old = found->get(key)) {
    const std::size_t begin = offset_of(text, old->source().begin), end = offset_of(text, old->source().end);
    return std::string(text).replace(begin, end - begin, value);
  }
  if (found->is_inline()) return add_inline(text, *found, entry);
  return add_line(text, *found, entry);
}

}  // namespace rakelight
