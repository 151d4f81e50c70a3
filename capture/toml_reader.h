// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A TOML table read key by key: wrong types, values out of range and unknown keys are refused with file:line:column.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rakelight {

/// @param file for messages. @throws InputError naming the place of the syntax error.
toml::table parse_toml(std::string_view text, const std::string& file);

class TomlReader {
 public:
  /// The table must outlive the reader. @param name of the table for messages, e.g. "[sensor]"; empty for the file.
  TomlReader(const toml::table& table, const std::string& file, const std::string& name);

  // Each returns nothing where the key is missing, and refuses a value of another kind or out of range.
  std::optional<std::string> text(const std::string& key);
  std::optional<bool> boolean(const std::string& key);
  std::optional<std::int64_t> integer(const std::string& key, std::int64_t least, std::int64_t most);
  std::optional<double> number(const std::string& key, double least, double most);
  std::optional<std::vector<double>> numbers(const std::string& key, double least, double most);
  std::vector<std::string> texts(const std::string& key);
  /// A list of lists of two texts.
  std::vector<std::array<std::string, 2>> pairs(const std::string& key);
  std::optional<TomlReader> table(const std::string& key);
  std::vector<TomlReader> tables(const std::string& key);
  /// A list of lists of numbers, all of one length.
  std::optional<std::vector<std::vector<double>>> rows(const std::string& key, double least, double most);
  bool is_text(const std::string& key) const { return table_->get(key) && table_->get(key)->is_string(); }

  /// As above into `field`, which stays as it is where the key is missing.
  void read(const std::string& key, std::string& field);
  void read(const std::string& key, bool& field);
  void read(const std::string& key, int& field, int least, int most);
  void read(const std::string& key, double& field, double least, double most);

  /// @throws InputError for the first key nobody has asked for, with the nearest of those that were.
  void refuse_unknown() const;
  /// @throws InputError at the key's value, or at the table where the key is missing (or empty).
  [[noreturn]] void refuse(const std::string& key, const std::string& fault, const std::string& cure) const;

 private:
  const toml::node* find(const std::string& key);
  std::string text_of(const toml::node& node, const std::string& key) const;
  double number_of(const toml::node& node, const std::string& key, double least, double most) const;
  [[noreturn]] void refuse_at(const toml::source_region& where, const std::string& fault,
                              const std::string& cure) const;
  std::string place(const std::string& key) const;

  const toml::table* table_;
  std::string file_, name_;
  std::set<std::string> known_;  ///< keys asked for
};

}  // namespace rakelight
