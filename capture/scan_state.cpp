// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/scan_state.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "stack/errors.h"

namespace rakelight {
namespace {

using json = nlohmann::json;
constexpr const char* kKey = "scan";

json faults_json(const std::vector<LampFault>& faults) {
  json list = json::array();
  for (const LampFault& fault : faults) {
    list.push_back({{"kind", to_string(fault.kind)},
                    {"lamp", fault.lamp},
                    {"other", fault.other},
                    {"level", fault.level},
                    {"message", fault.message}});
  }
  return list;
}

LampFault::Kind parse_kind(const std::string& text) {
  using Kind = LampFault::Kind;
  for (const Kind kind : {Kind::no_light, Kind::stuck_on, Kind::dim}) {
    if (text == to_string(kind)) return kind;
  }
  return Kind::swapped;
}

std::vector<LampFault> parse_faults(const json& list) {
  std::vector<LampFault> faults;
  for (const json& entry : list) {
    faults.push_back({parse_kind(entry.at("kind").get<std::string>()), entry.at("lamp").get<std::string>(),
                      entry.at("other").get<std::string>(), entry.at("level").get<double>(),
                      entry.at("message").get<std::string>()});
  }
  return faults;
}

}  // namespace

bool ScanState::has_slot(int slot) const {
  return std::any_of(stack.frames.begin(), stack.frames.end(),
                     [slot](const Frame& f) { return f.index == slot; });
}

std::string scan_keys(const ScanState& state) {
  return json{{kKey,
               {{"signatures", json::parse(state.signatures.text())},
                {"faults", faults_json(state.faults)},
                {"repeats", state.repeats},
                {"rgb_shot", state.rgb_shot}}}}
      .dump();
}

ScanState parse_scan_state(LightStack stack, const std::string& subject) {
  ScanState state;
  try {
    const json scan = json::parse(stack.unknown_keys).at(kKey);
    state.signatures =
        LitSignatures::parse(scan.at("signatures").dump(), stack.color_response, stack.color_camera.height);
    state.faults = parse_faults(scan.at("faults"));
    state.repeats = scan.at("repeats").get<int>();
    state.rgb_shot = scan.at("rgb_shot").get<bool>();
  } catch (const std::exception& error) {
    throw InputError(subject,
                     std::string("is no unfinished scan that can be gone on with (") + error.what() + ")",
                     "remove the folder and scan again");
  }
  state.stack = std::move(stack);
  state.stack.unknown_keys.clear();
  return state;
}

std::string finished_keys(const ScanState& state) {
  return json{{kKey, {{"faults", faults_json(state.faults)}}}}.dump();
}

}  // namespace rakelight
