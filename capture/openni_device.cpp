// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_device.h"

#include <OpenNI.h>

#include <atomic>

#include "capture/openni_session.h"
#include "capture/virtual_sensor.h"
#include "simulate/virtual_sensor/driver/protocol.h"

namespace rakelight {
namespace {

/// As on a real bus, a device that has been unplugged comes back at another address: the library opens none twice.
std::atomic<int> unplugged{0};

std::string virtual_uri() {
  const int times = unplugged;
  return driver_protocol::kVirtualUri + (times > 0 ? "-" + std::to_string(times) : "");
}

}  // namespace

OpenniDevice::OpenniDevice(const std::string& uri) {
  require_openni();
  device_ = std::make_unique<openni::Device>();
  if (device_->open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()) == openni::STATUS_OK) return;
  throw openni_error(std::errc::no_such_device, "cannot open the sensor " + (uri.empty() ? "(any)" : uri),
                     "rakelight doctor says what is plugged in and what is wrong");
}

OpenniDevice::~OpenniDevice() { device_->close(); }

bool OpenniDevice::set_property(int id, const void* data, std::size_t size) {
  return device_->setProperty(id, data, static_cast<int>(size)) == openni::STATUS_OK;
}

bool OpenniDevice::get_property(int id, void* data, std::size_t size) {
  int bytes = static_cast<int>(size);
  return device_->getProperty(id, data, &bytes) == openni::STATUS_OK;
}

void note_unplugged(const std::string& uri) {
  if (uri == virtual_uri()) ++unplugged;
}

std::unique_ptr<OpenniDevice> open_openni_device(const Rig& rig) {
  if (!rig.virtual_rig) return std::make_unique<OpenniDevice>(rig.sensor.uri);
  auto device = std::make_unique<OpenniDevice>(virtual_uri());
  const std::string text = virtual_sensor_text(rig);
  if (!device->set_property(driver_protocol::kSetup, text.data(), text.size())) {
    throw openni_error(std::errc::invalid_argument, "cannot set up the virtual sensor",
                       "correct [virtual_rig] in the rig file");
  }
  return device;
}

}  // namespace rakelight
