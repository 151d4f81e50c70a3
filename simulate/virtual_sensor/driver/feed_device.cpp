// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/feed_device.h"

#include "simulate/virtual_sensor/driver/sensor_stream.h"

namespace rakelight {
namespace {

using driver_protocol::FeedStream;
using driver_protocol::PushedFrame;

OniVideoMode mode_of(OniSensorType type, const FeedStream& stream) {
  const OniPixelFormat format =
      type == ONI_SENSOR_COLOR ? ONI_PIXEL_FORMAT_RGB888 : ONI_PIXEL_FORMAT_DEPTH_100_UM;
  return {format, stream.width, stream.height, 30};
}

class PushStream : public SensorStream {
 public:
  PushStream(OniSensorType type, const FeedStream& stream)
      : SensorStream(type, {mode_of(type, stream)}, {stream.horizontal_fov, stream.vertical_fov}),
        pixel_type_(type == ONI_SENSOR_COLOR ? CV_8UC3 : CV_16UC1) {}

  OniStatus start() override { return ONI_STATUS_OK; }
  void stop() override {}

  OniStatus setProperty(int id, const void* data, int bytes) override {
    if (id != driver_protocol::kPushFrame) return SensorStream::setProperty(id, data, bytes);
    PushedFrame frame;
    if (!accept(frame, data, bytes)) return ONI_STATUS_BAD_PARAMETER;
    // OpenCV has no view of constant memory; deliver() only reads.
    deliver(cv::Mat(size(), pixel_type_, const_cast<void*>(frame.pixels)), frame.index, frame.timestamp_us);
    return ONI_STATUS_OK;
  }

 private:
  const int pixel_type_;
};

}  // namespace

FeedDevice::FeedDevice() { announce(); }

void FeedDevice::announce() {
  infos_.set({mode_of(ONI_SENSOR_COLOR, setup_.color)}, {mode_of(ONI_SENSOR_DEPTH, setup_.depth)});
}

oni::driver::StreamBase* FeedDevice::createStream(OniSensorType type) {
  if (type == ONI_SENSOR_COLOR) return new PushStream(type, setup_.color);
  if (type == ONI_SENSOR_DEPTH) return new PushStream(type, setup_.depth);
  return nullptr;
}

OniStatus FeedDevice::setProperty(int id, const void* data, int size) {
  if (id != driver_protocol::kSetup) return ONI_STATUS_NOT_SUPPORTED;
  if (!accept(setup_, data, size)) return ONI_STATUS_BAD_PARAMETER;
  announce();
  return ONI_STATUS_OK;
}

}  // namespace rakelight
