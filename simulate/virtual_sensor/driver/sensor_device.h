// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What both devices of our OpenNI2 driver share: a colour and a depth stream, and how they are announced.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "simulate/virtual_sensor/driver/oni_driver_api.h"

namespace rakelight {

/// Puts a line where openni::OpenNI::getExtendedError() finds it.
using ReportError = std::function<void(const std::string&)>;

/// As the core wants them: an array that lives as long as the device.
class SensorInfos {
 public:
  void set(std::vector<OniVideoMode> color, std::vector<OniVideoMode> depth);
  OniStatus get(OniSensorInfo** infos, int* count);

 private:
  std::vector<OniVideoMode> color_, depth_;
  OniSensorInfo infos_[2];
};

OniDeviceInfo device_info(const char* uri);

}  // namespace rakelight
