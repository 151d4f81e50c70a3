// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_device.h"

#include <OpenNI.h>

#include "capture/virtual_sensor.h"
#include "simulate/virtual_sensor/driver/protocol.h"

namespace rakelight {

OpenniDevice::OpenniDevice(const std::string& uri) : device_(std::make_unique<openni::Device>()) {
  if (device_->open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()) == openni::STATUS_OK) return;
  throw openni_error(std::errc::no_such_device, "cannot open the sensor " + (uri.empty() ? "(any)" : uri),
                     "rakelight doctor says what is plugged in and what is wrong");
}

OpenniDevice::~OpenniDevice() { device_->close(); }

bool OpenniDevice::set_property(int id, const void* data, std::size_t size) {
  return device_->setProperty(id, data, static_cast<int>(size)) == openni::STATUS_OK;
}

std::unique_ptr<OpenniDevice> open_openni_device(const Rig& rig) {
  if (!rig.virtual_rig) return std::make_unique<OpenniDevice>(rig.sensor.uri);
  auto device = std::make_unique<OpenniDevice>(driver_protocol::kVirtualUri);
  const std::string text = virtual_sensor_text(rig);
  if (!device->set_property(driver_protocol::kSetup, text.data(), text.size())) {
    throw openni_error(std::errc::invalid_argument, "cannot set up the virtual sensor",
                       "correct [virtual_rig] in the rig file");
  }
  return device;
}

}  // namespace rakelight
