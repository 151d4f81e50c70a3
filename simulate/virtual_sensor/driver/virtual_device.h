// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The virtual sensor as an OpenNI2 device.
#pragma once

#include <memory>

#include "simulate/virtual_sensor/driver/protocol.h"
#include "simulate/virtual_sensor/driver/sensor_device.h"
#include "simulate/virtual_sensor/driver/virtual_rig_state.h"

namespace rakelight {

class VirtualDevice : public oni::driver::DeviceBase {
 public:
  VirtualDevice(std::function<void()> on_unplug, ReportError report);

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override { return infos_.get(infos, count); }
  oni::driver::StreamBase* createStream(OniSensorType type) override;
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }

 private:
  OniStatus set_up(const std::string& text);
  void fill(const driver_protocol::TruthBuffers& buffers);

  const ReportError report_;
  const std::shared_ptr<VirtualRigState> rig_;
  SensorInfos infos_;
};

}  // namespace rakelight
