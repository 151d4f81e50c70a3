// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/virtual_sensor.h"

#include <nlohmann/json.hpp>

#include "capture/openni_device.h"
#include "capture/openni_session.h"
#include "simulate/virtual_sensor/driver/protocol.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

using Json = nlohmann::json;

Json lamps_json(const std::vector<RigLamp>& lamps) {
  Json list = Json::array();
  for (const RigLamp& lamp : lamps) {
    Json entry = {{"id", lamp.id}, {"color", to_string(lamp.color)}};
    if (lamp.position_m)
      entry["position_m"] = {lamp.position_m->x(), lamp.position_m->y(), lamp.position_m->z()};
    list.push_back(std::move(entry));
  }
  return list;
}

class VirtualBank : public LineBank {
 public:
  explicit VirtualBank(const Rig& rig) : lamps_(rig.lamps.size()), device_(open_openni_device(rig)) {}

  std::size_t size() const override { return lamps_; }

  void write(const std::vector<bool>& lit) override {
    const std::vector<char> levels(lit.begin(), lit.end());
    if (!device_->set_property(driver_protocol::kLamps, levels.data(), levels.size())) {
      throw openni_error(
          std::errc::io_error, "cannot switch the virtual lamps",
          "the virtual sensor was set up with other lamps: open lamps and sensor with one rig");
    }
  }

  /// The lamps themselves rather than their lines: a lamp that is burnt out is not lit.
  std::vector<bool> read() override {
    std::vector<char> lit(lamps_);
    if (!device_->get_property(driver_protocol::kLamps, lit.data(), lit.size()))
      throw openni_error(std::errc::io_error, "cannot read the virtual lamps",
                         "open lamps and sensor with one rig");
    return {lit.begin(), lit.end()};
  }

 private:
  std::size_t lamps_;
  std::unique_ptr<OpenniDevice> device_;
};

}  // namespace

std::string virtual_sensor_text(const Rig& rig) {
  const VirtualRig& rules = *rig.virtual_rig;
  const SensorSetup& sensor = rig.sensor;
  return Json{{"scene", rules.scene},
              {"albedo", rules.albedo},
              {"seed", rules.seed},
              {"color_size", {sensor.color.width, sensor.color.height}},
              {"depth_size", {sensor.depth.width, sensor.depth.height}},
              {"response", to_string(rules.color_response)},
              {"crosstalk", rules.crosstalk},
              {"readout_us", sensor.readout_us},
              {"ignores_exposure", rules.ignores_exposure},
              {"lamps", lamps_json(rig.lamps)},
              {"lamp_latency_us", rules.lamp_latency_us},
              {"lamp_jitter_us", rules.lamp_jitter_us},
              {"delivery_latency_us", rules.delivery_latency_us},
              {"delivery_jitter_us", rules.delivery_jitter_us},
              {"drop_share", rules.drop_share},
              {"unplug_at_frame", rules.unplug_at_frame},
              {"stuck_on", rules.stuck_on},
              {"stuck_off", rules.stuck_off},
              {"dim", rules.dim},
              {"swapped", rules.swapped}}
      .dump();
}

GroundTruth virtual_truth(const Rig& rig) {
  const cv::Size size(rig.sensor.color.width, rig.sensor.color.height);
  GroundTruth truth{cv::Mat1f(size), cv::Mat3f(size), cv::Mat3f(size), {}};
  std::vector<driver_protocol::TruthLamp> lamps(rig.lamps.size());
  driver_protocol::TruthBuffers buffers{truth.depth.ptr<float>(), truth.normals.ptr<float>(),
                                        truth.albedo.ptr<float>(), lamps.data()};
  if (!open_openni_device(rig)->get_property(driver_protocol::kTruth, &buffers, sizeof buffers))
    throw openni_error(std::errc::io_error, "cannot read the virtual sensor's truth",
                       "open lamps and sensor with one rig");
  for (std::size_t k = 0; k < lamps.size(); ++k) {
    const RigLamp& lamp = rig.lamps[k];
    truth.lamps.push_back({lamp.id, lamp.color, lamp.position_m.has_value(), lamp.position_m,
                           Eigen::Vector3d(lamps[k].direction), Eigen::Vector3d(lamps[k].strength)});
  }
  return truth;
}

std::unique_ptr<LineBank> open_virtual_bank(const Rig& rig) { return std::make_unique<VirtualBank>(rig); }

}  // namespace rakelight
