// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/setup.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "stack/color_response.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& fault) {
  throw InputError("virtual rig", fault, "correct the [virtual] part of the rig file");
}

template <class Value>
Value word(const std::map<std::string, Value>& words, const std::string& key, const std::string& text) {
  const auto found = words.find(text);
  if (found != words.end()) return found->second;
  std::string known;
  for (const auto& [name, value] : words) known += (known.empty() ? "" : ", ") + name;
  refuse(key + " \"" + text + "\" is unknown (known: " + known + ")");
}

const std::map<std::string, SceneKind> kScenes{{"vase", SceneKind::vase},
                                               {"coin", SceneKind::coin},
                                               {"drape", SceneKind::drape},
                                               {"sphere", SceneKind::sphere},
                                               {"plane", SceneKind::plane}};
const std::map<std::string, AlbedoKind> kAlbedos{{"simple", AlbedoKind::simple},
                                                 {"pattern", AlbedoKind::pattern},
                                                 {"complicated", AlbedoKind::complicated}};
const std::map<std::string, LampColor> kColors{{"red", LampColor::red},
                                               {"green", LampColor::green},
                                               {"blue", LampColor::blue},
                                               {"white", LampColor::white}};

cv::Size size_of(const Json& json, cv::Size otherwise) {
  if (json.is_null()) return otherwise;
  return {json.at(0).get<int>(), json.at(1).get<int>()};
}

std::vector<VirtualLamp> lamps_of(const Json& json) {
  std::vector<VirtualLamp> lamps;
  for (const Json& entry : json) {
    VirtualLamp lamp{entry.at("id"), word(kColors, "color", entry.at("color").get<std::string>()), {}};
    if (entry.contains("position_m")) {
      const auto p = entry["position_m"].get<std::array<double, 3>>();
      lamp.position_m = Eigen::Vector3d(p[0], p[1], p[2]);
    }
    lamps.push_back(std::move(lamp));
  }
  return lamps;
}

class LampNumbers {
 public:
  explicit LampNumbers(const std::vector<VirtualLamp>& lamps) : lamps_(lamps) {}

  std::size_t operator()(const std::string& id) const {
    const auto found =
        std::find_if(lamps_.begin(), lamps_.end(), [&id](const VirtualLamp& lamp) { return lamp.id == id; });
    if (found == lamps_.end()) refuse("a fault names \"" + id + "\", which is no lamp of the rig");
    return static_cast<std::size_t>(found - lamps_.begin());
  }

  std::vector<std::size_t> list(const Json& ids) const {
    std::vector<std::size_t> numbers;
    for (const Json& id : ids) numbers.push_back((*this)(id.get<std::string>()));
    return numbers;
  }

 private:
  const std::vector<VirtualLamp>& lamps_;
};

LampWiring wiring_of(const Json& json, const VirtualSensorSetup& setup) {
  LampWiring wiring;
  const LampNumbers number(setup.lamps);
  wiring.lamps = setup.lamps.size();
  wiring.seed = setup.seed;
  wiring.latency_us = json.value("lamp_latency_us", wiring.latency_us);
  wiring.jitter_us = json.value("lamp_jitter_us", wiring.jitter_us);
  wiring.stuck_on = number.list(json.value("stuck_on", Json::array()));
  wiring.stuck_off = number.list(json.value("stuck_off", Json::array()));
  wiring.dim = number.list(json.value("dim", Json::array()));
  for (const Json& pair : json.value("swapped", Json::array())) {
    wiring.swapped.emplace_back(number(pair.at(0)), number(pair.at(1)));
  }
  return wiring;
}

FrameScheduleOptions frames_of(const Json& json, std::uint64_t seed) {
  FrameScheduleOptions frames;
  frames.seed = seed;
  frames.period_us = json.value("period_us", frames.period_us);
  frames.delivery_latency_us = json.value("delivery_latency_us", frames.delivery_latency_us);
  frames.delivery_jitter_us = json.value("delivery_jitter_us", frames.delivery_jitter_us);
  frames.drop_share = json.value("drop_share", frames.drop_share);
  return frames;
}

VirtualSensorSetup setup_of(const Json& json) {
  VirtualSensorSetup setup;
  setup.scene = word(kScenes, "scene", json.value("scene", "vase"));
  setup.albedo = word(kAlbedos, "albedo", json.value("albedo", "pattern"));
  setup.seed = json.value("seed", setup.seed);
  setup.color_size = size_of(json.value("color_size", Json()), setup.color_size);
  setup.depth_size = size_of(json.value("depth_size", Json()), setup.depth_size);
  setup.response = parse_color_response(json.value("response", "linear"));
  setup.crosstalk = json.value("crosstalk", setup.crosstalk);
  setup.readout_us = json.value("readout_us", setup.readout_us);
  setup.ignores_exposure = json.value("ignores_exposure", setup.ignores_exposure);
  setup.unplug_at_frame = json.value("unplug_at_frame", setup.unplug_at_frame);
  setup.lamps = lamps_of(json.value("lamps", Json::array()));
  setup.wiring = wiring_of(json, setup);
  setup.frames = frames_of(json, setup.seed);
  return setup;
}

}  // namespace

VirtualSensorSetup parse_virtual_setup(const std::string& text) {
  try {
    return setup_of(Json::parse(text));
  } catch (const Json::exception& error) { refuse(error.what()); } catch (const UsageError& error) {
    refuse(error.what());
  }
}

}  // namespace rakelight
