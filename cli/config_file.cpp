// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/config_file.h"

#include <toml++/toml.h>
#include <cmath>
#include <set>
#include <string>
#include <type_traits>

#include "refine/option_fields.h"
#include "stack/checked_file.h"
#include "stack/errors.h"

namespace rakelight::cli {
namespace {

constexpr std::uint64_t kMaxConfigBytes = 1 << 20;

/// A configuration file and what it says about single parameters.
class Config {
 public:
  explicit Config(const std::filesystem::path& file) : file_(file.string()) {
    if (file.empty()) return;
    const Bytes bytes = read_file(file, kMaxConfigBytes);
    try {
      root_ = toml::parse(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), file_);
    } catch (const toml::parse_error& error) {
      refuse(error.source(), std::string(error.description()), "correct the TOML syntax");
    }
  }

  /// Sets the field if the file names it.
  template <class T>
  void read(const std::string& name, T& field) {
    known_.insert(name);
    const toml::node_view<toml::node> node = root_.at_path(name);
    if (node) set(name, *node.node(), field);
  }

  /// Refuses the first key that no parameter has read.
  void refuse_unknown() const { refuse_unknown(root_, ""); }

 private:
  void refuse_unknown(const toml::table& table, const std::string& prefix) const {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      if (known_.count(name) != 0) continue;
      if (!is_group(name)) {
        refuse(key.source(), "'" + name + "' is no parameter", "see options in a result.json for the names");
      }
      if (!node.is_table()) refuse(node.source(), "'" + name + "' is a group", "write [" + name + "]");
      refuse_unknown(*node.as_table(), name + ".");
    }
  }

  bool is_group(const std::string& name) const {
    const auto member = known_.lower_bound(name + ".");
    return member != known_.end() && member->compare(0, name.size() + 1, name + ".") == 0;
  }

  void set(const std::string& name, const toml::node& node, bool& field) const {
    const auto value = node.value_exact<bool>();
    if (!value) refuse(node.source(), "'" + name + "' is not true or false", "write true or false");
    field = *value;
  }
  void set(const std::string& name, const toml::node& node, int& field) const {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || *value < 0 || *value > 1'000'000) {
      refuse(node.source(), "'" + name + "' is no whole number from 0 to 1000000", "write such a number");
    }
    field = static_cast<int>(*value);
  }
  void set(const std::string& name, const toml::node& node, double& field) const {
    const auto value = node.value<double>();
    if (!node.is_number() || !value || !std::isfinite(*value) || *value < 0) {
      refuse(node.source(), "'" + name + "' is no finite number of at least 0", "write such a number");
    }
    field = *value;
  }
  template <class Enum, class = std::enable_if_t<std::is_enum_v<Enum>>>
  void set(const std::string& name, const toml::node& node, Enum& field) const {
    const auto text = node.value_exact<std::string>();
    std::string names;
    for (const Enum value : kValuesOf<Enum>) {
      if (text && *text == to_string(value)) {
        field = value;
        return;
      }
      names += (names.empty() ? "" : ", ") + to_string(value);
    }
    refuse(node.source(), "'" + name + "' has no such value", "write one of: " + names);
  }

  [[noreturn]] void refuse(const toml::source_region& where, const std::string& fault,
                           const std::string& cure) const {
    throw InputError(file_ + " line " + std::to_string(where.begin.line), fault, cure);
  }

  std::string file_;
  toml::table root_;
  std::set<std::string> known_;  ///< every name asked for so far
};

}  // namespace

RefineOptions read_options(const std::filesystem::path& file, const PresetChoice& choice) {
  Config config(file);
  Preset preset = RefineOptions().preset;
  Method method = RefineOptions().method;
  config.read("preset", preset);
  config.read("method", method);
  RefineOptions options = preset_options(choice.preset.value_or(preset), choice.method.value_or(method));
  for_each_option(options, [&](const std::string& name, auto& field) { config.read(name, field); });
  config.refuse_unknown();
  options.preset = choice.preset.value_or(preset);
  options.method = choice.method.value_or(method);
  return options;
}

}  // namespace rakelight::cli
