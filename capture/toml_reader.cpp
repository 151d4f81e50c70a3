// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/toml_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "stack/errors.h"

namespace rakelight {
namespace {

std::string position(const std::string& file, const toml::source_position& at) {
  return file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

std::string plain(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr};
}

/// Levenshtein distance: single characters inserted, left out or changed.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row.back();
}

/// What was probably meant: the nearest known key, if a few slips explain it; else the list of all.
std::string suggestion(const std::string& key, const std::set<std::string>& known) {
  std::string nearest, all;
  for (const std::string& candidate : known) {
    all += (all.empty() ? "" : ", ") + candidate;
    if (nearest.empty() || edits_between(key, candidate) < edits_between(key, nearest)) nearest = candidate;
  }
  if (!nearest.empty() && edits_between(key, nearest) <= 1 + key.size() / 3) {
    return "did you mean '" + nearest + "'?";
  }
  return "known here: " + all;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw InputError(position(file, error.source().begin), std::string(error.description()),
                     "correct the TOML syntax (toml.io)");
  }
}

TomlReader::TomlReader(const toml::table& table, const std::string& file, const std::string& name)
    : table_(&table), file_(file), name_(name) {}

const toml::node* TomlReader::find(const std::string& key) {
  known_.insert(key);
  return table_->get(key);
}

std::string TomlReader::place(const std::string& key) const {
  if (key.empty()) return name_.empty() ? "the file" : name_;
  return "'" + key + "'" + (name_.empty() ? "" : " of " + name_);
}

void TomlReader::refuse_at(const toml::source_region& where, const std::string& fault,
                           const std::string& cure) const {
  throw InputError(position(file_, where.begin), fault, cure);
}

void TomlReader::refuse(const std::string& key, const std::string& fault, const std::string& cure) const {
  const toml::node* node = key.empty() ? nullptr : table_->get(key);
  refuse_at(node != nullptr ? node->source() : table_->source(), place(key) + " " + fault, cure);
}

std::optional<std::string> TomlReader::text(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const auto value = node->value_exact<std::string>();
  if (!value) refuse(key, "is no text", "write it in quotes");
  return value;
}

std::optional<bool> TomlReader::boolean(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const auto value = node->value_exact<bool>();
  if (!value) refuse(key, "is neither true nor false", "write true or false");
  return value;
}

std::optional<std::int64_t> TomlReader::integer(const std::string& key, std::int64_t least,
                                                std::int64_t most) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const auto value = node->value_exact<std::int64_t>();
  if (!value || *value < least || *value > most) {
    refuse(key, "is no whole number from " + std::to_string(least) + " to " + std::to_string(most),
           "write such a number");
  }
  return value;
}

std::string TomlReader::text_of(const toml::node& node, const std::string& key) const {
  const auto value = node.value_exact<std::string>();
  if (!value) refuse_at(node.source(), place(key) + " holds something that is no text", "write it in quotes");
  return *value;
}

double TomlReader::number_of(const toml::node& node, const std::string& key, double least,
                             double most) const {
  const auto value = node.value<double>();
  if (!node.is_number() || !value || !(*value >= least && *value <= most)) {  // NaN is in no range
    refuse_at(node.source(), place(key) + " is no number from " + plain(least) + " to " + plain(most),
              "write such a number");
  }
  return *value;
}

std::optional<double> TomlReader::number(const std::string& key, double least, double most) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  return number_of(*node, key, least, most);
}

std::optional<std::vector<double>> TomlReader::numbers(const std::string& key, double least, double most) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) refuse(key, "is no list", "write numbers in [ ]");
  std::vector<double> values;
  for (const toml::node& element : *node->as_array()) values.push_back(number_of(element, key, least, most));
  return values;
}

std::optional<std::vector<std::vector<double>>> TomlReader::rows(const std::string& key, double least,
                                                                 double most) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) refuse(key, "is no list of rows", "write [[...], [...]]");
  std::vector<std::vector<double>> rows;
  for (const toml::node& row : *node->as_array()) {
    if (!row.is_array())
      refuse_at(row.source(), place(key) + " has a row that is no list", "write [[...], [...]]");
    rows.emplace_back();
    for (const toml::node& element : *row.as_array())
      rows.back().push_back(number_of(element, key, least, most));
    if (rows.back().size() != rows.front().size()) {
      refuse_at(row.source(), place(key) + " has rows of different lengths", "write as many numbers in each");
    }
  }
  return rows;
}

std::vector<std::string> TomlReader::texts(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (!node->is_array()) refuse(key, "is no list", "write texts in [ ]");
  std::vector<std::string> values;
  for (const toml::node& element : *node->as_array()) values.push_back(text_of(element, key));
  return values;
}

std::vector<std::array<std::string, 2>> TomlReader::pairs(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const std::string cure = "write [[\"one\", \"other\"], ...]";
  if (!node->is_array()) refuse(key, "is no list of pairs", cure);
  std::vector<std::array<std::string, 2>> values;
  for (const toml::node& element : *node->as_array()) {
    const toml::array* pair = element.as_array();
    if (pair == nullptr || pair->size() != 2)
      refuse_at(element.source(), place(key) + " holds no pair", cure);
    values.push_back({text_of((*pair)[0], key), text_of((*pair)[1], key)});
  }
  return values;
}

std::optional<TomlReader> TomlReader::table(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  if (!node->is_table()) refuse(key, "is no table", "write [" + key + "] or " + key + " = { ... }");
  return TomlReader(*node->as_table(), file_, name_.empty() ? "[" + key + "]" : place(key));
}

std::vector<TomlReader> TomlReader::tables(const std::string& key) {
  const toml::node* node = find(key);
  if (node == nullptr) return {};
  const std::string cure = "write [[" + key + "]] before each";
  if (!node->is_array()) refuse(key, "is no list of tables", cure);
  std::vector<TomlReader> readers;
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_table())
      refuse_at(element.source(), place(key) + " holds something that is no table", cure);
    readers.emplace_back(*element.as_table(), file_, "[[" + key + "]] " + std::to_string(readers.size() + 1));
  }
  return readers;
}

void TomlReader::read(const std::string& key, std::string& field) { field = text(key).value_or(field); }
void TomlReader::read(const std::string& key, bool& field) { field = boolean(key).value_or(field); }
void TomlReader::read(const std::string& key, int& field, int least, int most) {
  field = static_cast<int>(integer(key, least, most).value_or(field));
}
void TomlReader::read(const std::string& key, double& field, double least, double most) {
  field = number(key, least, most).value_or(field);
}

void TomlReader::refuse_unknown() const {
  for (const auto& [key, node] : *table_) {
    const std::string name(key.str());
    if (known_.count(name) != 0) continue;
    refuse_at(key.source(), place(name) + " is not known", suggestion(name, known_));
  }
}

}  // namespace rakelight
