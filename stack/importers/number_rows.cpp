// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/importers/number_rows.h"

#include <charconv>
#include <cmath>

#include "stack/checked_file.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr std::uint64_t kMaxTextBytes = 1 << 20;
constexpr std::string_view kSeparators = " \t\r,";

std::vector<double> parse_row(std::string_view line, const std::string& where) {
  std::vector<double> row;
  for (;;) {
    const std::size_t start = line.find_first_not_of(kSeparators);
    if (start == std::string_view::npos) return row;
    line.remove_prefix(start);
    const std::size_t length = std::min(line.find_first_of(kSeparators), line.size());
    double value = 0;
    const auto parsed = std::from_chars(line.data(), line.data() + length, value);
    if (parsed.ec != std::errc() || parsed.ptr != line.data() + length || !std::isfinite(value)) {
      throw InputError(
          where, "'" + std::string(line.substr(0, std::min<std::size_t>(length, 20))) + "' is no number",
          "write plain decimal numbers");
    }
    row.push_back(value);
    line.remove_prefix(length);
  }
}

}  // namespace

std::vector<std::vector<double>> parse_number_rows(std::string_view text, const std::string& file) {
  std::vector<std::vector<double>> rows;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    std::vector<double> row = parse_row(text.substr(0, length), file + " line " + std::to_string(line));
    if (!row.empty()) rows.push_back(std::move(row));
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return rows;
}

std::vector<std::vector<double>> read_number_rows(const std::filesystem::path& file) {
  const Bytes bytes = read_file(file, kMaxTextBytes);
  return parse_number_rows({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace rakelight
