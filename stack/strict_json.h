// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// JSON from untrusted files: duplicate keys, deep nesting, control characters and wrong types become InputError with
// the place named, and the keys nobody asked for can be kept.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rakelight {

/// @param file named in messages  @throws InputError if the text is not strict JSON (UTF-8, no duplicate keys,
/// at most 32 levels deep).
nlohmann::json parse_strict_json(const std::string& text, const std::string& file);

/// Reads the members of one JSON object; `place` (file and path of keys) starts every message. The JSON must outlive it.
class ObjectReader {
 public:
  /// @throws InputError if `value` is no object.
  ObjectReader(const nlohmann::json& value, std::string place);

  /// The member, or null if it is missing or JSON null.
  const nlohmann::json* find(const std::string& key);
  /// The member; its absence is an InputError.
  const nlohmann::json& get(const std::string& key);

  double number(const std::string& key, double lowest, double highest);
  std::optional<double> maybe_number(const std::string& key, double lowest, double highest);
  std::int64_t integer(const std::string& key, std::int64_t lowest, std::int64_t highest);
  std::optional<std::int64_t> maybe_integer(const std::string& key, std::int64_t lowest,
                                            std::int64_t highest);
  bool boolean(const std::string& key);
  std::string text(const std::string& key);                         ///< required
  std::string text(const std::string& key, std::string otherwise);  ///< `otherwise` if missing
  std::optional<std::vector<double>> maybe_numbers(const std::string& key);
  std::optional<ObjectReader> maybe_object(const std::string& key);
  std::vector<ObjectReader> objects(const std::string& key, std::size_t most);

  /// The members nobody asked for.
  nlohmann::json unknown() const;

  /// Refuses the member `key`. @throws InputError always.
  [[noreturn]] void refuse(const std::string& key, const std::string& fault, const std::string& cure) const;
  const std::string& place() const { return place_; }

 private:
  const nlohmann::json* object_;
  std::string place_;
  std::set<std::string> known_;
};

}  // namespace rakelight
