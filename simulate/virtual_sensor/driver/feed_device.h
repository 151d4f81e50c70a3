// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A device whose frames come from the program that opened it.
#pragma once

#include "simulate/virtual_sensor/driver/protocol.h"
#include "simulate/virtual_sensor/driver/sensor_device.h"

namespace rakelight {

class FeedDevice : public oni::driver::DeviceBase {
 public:
  FeedDevice();

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override { return infos_.get(infos, count); }
  oni::driver::StreamBase* createStream(OniSensorType type) override;
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }
  OniStatus setProperty(int id, const void* data, int size) override;
  OniBool isPropertySupported(int id) override { return static_cast<OniBool>(id == driver_protocol::kSetup); }

 private:
  void announce();

  driver_protocol::FeedSetup setup_{{640, 480, 1.02f, 0.8f}, {640, 480, 1.02f, 0.8f}};
  SensorInfos infos_;
};

}  // namespace rakelight
