// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The OpenNI2 driver: what the library loads. Our devices appear when their address is asked for, so that they never stand in
// for a real sensor.
#include <cstring>
#include <mutex>
#include <set>
#include <string>

#include "simulate/virtual_sensor/driver/feed_device.h"
#include "simulate/virtual_sensor/driver/virtual_device.h"

namespace rakelight {
namespace {

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus tryDevice(const char* uri) override {
    if (std::strcmp(uri, driver_protocol::kVirtualUri) != 0 &&
        std::strcmp(uri, driver_protocol::kFeedUri) != 0) {
      return ONI_STATUS_ERROR;
    }
    const OniDeviceInfo info = device_info(uri);
    deviceConnected(&info);
    return ONI_STATUS_OK;
  }

  oni::driver::DeviceBase* deviceOpen(const char* uri, const char*) override {
    if (std::strcmp(uri, driver_protocol::kFeedUri) == 0) return new FeedDevice();
    return new VirtualDevice(
        [this] { disconnect(driver_protocol::kVirtualUri); },
        [this](const std::string& line) { getServices().errorLoggerAppend("%s", line.c_str()); });
  }

  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {}

  /// Both streams run on one clock as it is; the library only wants to hear that it is so.
  void* enableFrameSync(oni::driver::StreamBase**, int) override { return this; }

 private:
  void disconnect(const char* uri) {
    const OniDeviceInfo info = device_info(uri);
    deviceDisconnected(&info);
  }
};

}  // namespace
}  // namespace rakelight

using RakelightDriver = rakelight::Driver;
ONI_EXPORT_DRIVER(RakelightDriver)
