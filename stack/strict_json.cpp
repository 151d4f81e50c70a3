// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "stack/strict_json.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stack/errors.h"

namespace rakelight {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 32;
constexpr std::size_t kMaxText = 4096;
constexpr const char* kMend = "mend the file or write it again";

std::string range_text(double lowest, double highest) {
  return "write a number from " + json(lowest).dump() + " to " + json(highest).dump();
}

bool has_control_character(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
}

}  // namespace

json parse_strict_json(const std::string& text, const std::string& file) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto check = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMaxDepth) throw InputError(file, "is nested too deeply", kMend);
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second) {
      throw InputError(file, "has the key " + parsed.dump() + " twice", kMend);
    }
    return true;
  };
  try {
    return json::parse(text, check);
  } catch (const json::parse_error& error) {
    throw InputError(file, "is not valid JSON at byte " + std::to_string(error.byte), kMend);
  } catch (const json::exception&) {
    throw InputError(file, "is not valid JSON (a number is out of range)", kMend);
  }
}

ObjectReader::ObjectReader(const json& value, std::string place) : object_(&value), place_(std::move(place)) {
  if (!value.is_object()) throw InputError(place_, "is no JSON object", kMend);
}

void ObjectReader::refuse(const std::string& key, const std::string& fault, const std::string& cure) const {
  throw InputError(place_ + " " + key, fault, cure);
}

const json* ObjectReader::find(const std::string& key) {
  known_.insert(key);
  const auto member = object_->find(key);
  return member == object_->end() || member->is_null() ? nullptr : &*member;
}

const json& ObjectReader::get(const std::string& key) {
  const json* member = find(key);
  if (member == nullptr) refuse(key, "is missing", "add it");
  return *member;
}

double ObjectReader::number(const std::string& key, double lowest, double highest) {
  get(key);
  return *maybe_number(key, lowest, highest);
}

std::optional<double> ObjectReader::maybe_number(const std::string& key, double lowest, double highest) {
  const json* member = find(key);
  if (member == nullptr) return {};
  const double value = member->is_number() ? member->get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(value >= lowest && value <= highest)) refuse(key, "is no usable number", range_text(lowest, highest));
  return value;
}

std::int64_t ObjectReader::integer(const std::string& key, std::int64_t lowest, std::int64_t highest) {
  get(key);
  return *maybe_integer(key, lowest, highest);
}

std::optional<std::int64_t> ObjectReader::maybe_integer(const std::string& key, std::int64_t lowest,
                                                        std::int64_t highest) {
  const json* member = find(key);
  if (member == nullptr) return {};
  const bool fits = member->is_number_integer() &&
                    !(member->is_number_unsigned() &&
                      member->get<std::uint64_t>() > std::uint64_t{std::numeric_limits<std::int64_t>::max()});
  if (!fits || member->get<std::int64_t>() < lowest || member->get<std::int64_t>() > highest) {
    refuse(key, "is no usable whole number",
           "write one from " + std::to_string(lowest) + " to " + std::to_string(highest));
  }
  return member->get<std::int64_t>();
}

bool ObjectReader::boolean(const std::string& key) {
  const json& member = get(key);
  if (!member.is_boolean()) refuse(key, "is neither true nor false", "write one of them");
  return member.get<bool>();
}

std::string ObjectReader::text(const std::string& key) {
  get(key);
  return text(key, "");
}

std::string ObjectReader::text(const std::string& key, std::string otherwise) {
  const json* member = find(key);
  if (member == nullptr) return otherwise;
  if (!member->is_string()) refuse(key, "is no text", "write it in quotation marks");
  std::string value = member->get<std::string>();
  if (value.size() > kMaxText) refuse(key, "is too long", "shorten it");
  if (has_control_character(value)) refuse(key, "holds a control character", "remove it");
  return value;
}

std::optional<std::vector<double>> ObjectReader::maybe_numbers(const std::string& key) {
  const json* member = find(key);
  if (member == nullptr) return {};
  std::vector<double> values;
  if (!member->is_array()) refuse(key, "is no list of numbers", "write one in square brackets");
  for (const json& element : *member) {
    if (!element.is_number() || !std::isfinite(element.get<double>())) {
      refuse(key, "is no list of numbers", "write finite numbers only");
    }
    values.push_back(element.get<double>());
  }
  return values;
}

std::optional<ObjectReader> ObjectReader::maybe_object(const std::string& key) {
  const json* member = find(key);
  if (member == nullptr) return {};
  return ObjectReader(*member, place_ + " " + key);
}

std::vector<ObjectReader> ObjectReader::objects(const std::string& key, std::size_t most) {
  const json& member = get(key);
  if (!member.is_array()) refuse(key, "is no list", "write one in square brackets");
  if (member.size() > most) refuse(key, "has too many entries", "use at most " + std::to_string(most));
  std::vector<ObjectReader> result;
  for (const json& element : member) {
    result.emplace_back(element, place_ + " " + key + "[" + std::to_string(result.size()) + "]");
  }
  return result;
}

json ObjectReader::unknown() const {
  json result = json::object();
  for (const auto& [key, value] : object_->items()) {
    if (known_.count(key) == 0) result[key] = value;
  }
  return result;
}

}  // namespace rakelight
