// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/virtual_device.h"

#include <algorithm>

#include "simulate/virtual_sensor/driver/color_stream.h"
#include "simulate/virtual_sensor/driver/depth_stream.h"

namespace rakelight {

VirtualDevice::VirtualDevice(std::function<void()> on_unplug, ReportError report)
    : report_(std::move(report)), rig_(std::make_shared<VirtualRigState>(std::move(on_unplug))) {
  infos_.set(color_modes(rig_->setup().color_size), depth_modes(rig_->setup().depth_size));
}

oni::driver::StreamBase* VirtualDevice::createStream(OniSensorType type) {
  if (type == ONI_SENSOR_COLOR) return new ColorStream(rig_);
  if (type == ONI_SENSOR_DEPTH) return new DepthStream(rig_);
  return nullptr;
}

OniStatus VirtualDevice::set_up(const std::string& text) {
  try {
    rig_->set_up(text);
    infos_.set(color_modes(rig_->setup().color_size), depth_modes(rig_->setup().depth_size));
    return ONI_STATUS_OK;
  } catch (const std::exception& error) {
    report_(error.what());
    return ONI_STATUS_BAD_PARAMETER;
  }
}

OniStatus VirtualDevice::setProperty(int id, const void* data, int size) {
  const auto* bytes = static_cast<const char*>(data);
  if (id == driver_protocol::kSetup) return set_up(std::string(bytes, bytes + size));
  if (id == driver_protocol::kLamps) {
    const std::vector<bool> lines(bytes, bytes + size);
    return rig_->write_lamps(lines) ? ONI_STATUS_OK : ONI_STATUS_BAD_PARAMETER;
  }
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION &&
      size == static_cast<int>(sizeof(OniImageRegistrationMode))) {
    rig_->set_registered(*static_cast<const OniImageRegistrationMode*>(data) ==
                         ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR);
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

void VirtualDevice::fill(const driver_protocol::TruthBuffers& buffers) {
  const GroundTruth truth = rig_->truth();
  const cv::Size size = truth.depth.size();
  truth.depth.copyTo(cv::Mat(size, CV_32FC1, buffers.depth));
  truth.normals.copyTo(cv::Mat(size, CV_32FC3, buffers.normals));
  truth.albedo.copyTo(cv::Mat(size, CV_32FC3, buffers.albedo));
  for (std::size_t k = 0; k < truth.lamps.size(); ++k) {
    std::copy_n(truth.lamps[k].direction.data(), 3, buffers.lamps[k].direction);
    std::copy_n(truth.lamps[k].strength.data(), 3, buffers.lamps[k].strength);
  }
}

OniStatus VirtualDevice::getProperty(int id, void* data, int* size) {
  if (id == driver_protocol::kLamps) {
    const std::vector<bool> lit = rig_->lit_lamps();
    if (*size != static_cast<int>(lit.size())) return ONI_STATUS_BAD_PARAMETER;
    std::copy(lit.begin(), lit.end(), static_cast<char*>(data));
    return ONI_STATUS_OK;
  }
  if (id == driver_protocol::kTruth) {
    if (*size != static_cast<int>(sizeof(driver_protocol::TruthBuffers))) return ONI_STATUS_BAD_PARAMETER;
    fill(*static_cast<const driver_protocol::TruthBuffers*>(data));
    return ONI_STATUS_OK;
  }
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  const OniImageRegistrationMode mode =
      rig_->registered() ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF;
  return answer(mode, data, size);
}

OniBool VirtualDevice::isPropertySupported(int id) {
  return static_cast<OniBool>(id == driver_protocol::kSetup || id == driver_protocol::kLamps ||
                              id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION);
}

}  // namespace rakelight
