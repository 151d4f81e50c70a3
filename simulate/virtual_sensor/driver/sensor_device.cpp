// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/sensor_device.h"

#include <cstdio>

namespace rakelight {

void SensorInfos::set(std::vector<OniVideoMode> color, std::vector<OniVideoMode> depth) {
  color_ = std::move(color);
  depth_ = std::move(depth);
  infos_[0] = {ONI_SENSOR_COLOR, static_cast<int>(color_.size()), color_.data()};
  infos_[1] = {ONI_SENSOR_DEPTH, static_cast<int>(depth_.size()), depth_.data()};
}

OniStatus SensorInfos::get(OniSensorInfo** infos, int* count) {
  *infos = infos_;
  *count = 2;
  return ONI_STATUS_OK;
}

OniDeviceInfo device_info(const char* uri) {
  OniDeviceInfo info{};
  std::snprintf(info.uri, sizeof info.uri, "%s", uri);
  std::snprintf(info.vendor, sizeof info.vendor, "Rakelight");
  std::snprintf(info.name, sizeof info.name, "virtual sensor");
  return info;
}

}  // namespace rakelight
