// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/sensor_stream.h"

#include <algorithm>
#include <cmath>

namespace rakelight {
namespace {

constexpr int kFarthestRaw = 65535;

bool same(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX && a.resolutionY == b.resolutionY &&
         a.fps == b.fps;
}

}  // namespace

FieldOfView field_of_view(const Camera& camera) {
  return {static_cast<float>(2 * std::atan(camera.width / 2.0 / camera.fx)),
          static_cast<float>(2 * std::atan(camera.height / 2.0 / camera.fy))};
}

SensorStream::SensorStream(OniSensorType type, std::vector<OniVideoMode> modes, FieldOfView view)
    : type_(type), modes_(std::move(modes)), view_(view), mode_(modes_.front()) {}

OniVideoMode SensorStream::mode() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return mode_;
}

cv::Size SensorStream::size() const {
  const OniVideoMode now = mode();
  return {now.resolutionX, now.resolutionY};
}

OniStatus SensorStream::set_mode(const OniVideoMode& mode) {
  const auto known =
      std::find_if(modes_.begin(), modes_.end(), [&mode](const OniVideoMode& m) { return same(m, mode); });
  if (known == modes_.end()) return ONI_STATUS_NOT_SUPPORTED;
  const std::lock_guard<std::mutex> lock(mutex_);
  mode_ = mode;
  cropping_ = {};
  return ONI_STATUS_OK;
}

OniStatus SensorStream::set_cropping(const OniCropping& cropping) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const cv::Rect whole(0, 0, mode_.resolutionX, mode_.resolutionY);
  const cv::Rect part(cropping.originX, cropping.originY, cropping.width, cropping.height);
  if (cropping.enabled != 0 && (part.area() <= 0 || (part & whole) != part)) return ONI_STATUS_BAD_PARAMETER;
  cropping_ = cropping;
  return ONI_STATUS_OK;
}

OniStatus SensorStream::setProperty(int id, const void* data, int size) {
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    OniVideoMode mode;
    return accept(mode, data, size) ? set_mode(mode) : ONI_STATUS_BAD_PARAMETER;
  }
  if (id == ONI_STREAM_PROPERTY_CROPPING) {
    OniCropping cropping;
    return accept(cropping, data, size) ? set_cropping(cropping) : ONI_STATUS_BAD_PARAMETER;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus SensorStream::getProperty(int id, void* data, int* size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return answer(mode_, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      return answer(cropping_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return answer(view_.horizontal, data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return answer(view_.vertical, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return answer(OniBool{FALSE}, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return answer(int{0}, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return answer(int{kFarthestRaw}, data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool SensorStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_CROPPING:  // without it a recording plays back no frames
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_MIRRORING:
      return TRUE;
    case ONI_STREAM_PROPERTY_MIN_VALUE:
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return static_cast<OniBool>(type_ == ONI_SENSOR_DEPTH);
    default:
      return FALSE;
  }
}

cv::Rect SensorStream::visible_part() const {
  if (cropping_.enabled == 0) return {0, 0, mode_.resolutionX, mode_.resolutionY};
  return {cropping_.originX, cropping_.originY, cropping_.width, cropping_.height};
}

void SensorStream::deliver(const cv::Mat& image, int index, std::uint64_t timestamp_us) {
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const cv::Rect part = visible_part();
    frame->sensorType = type_;
    frame->frameIndex = index;
    frame->timestamp = timestamp_us;
    frame->videoMode = mode_;
    frame->width = part.width;
    frame->height = part.height;
    frame->croppingEnabled = cropping_.enabled;
    frame->cropOriginX = part.x;
    frame->cropOriginY = part.y;
    frame->stride = part.width * static_cast<int>(image.elemSize());
    frame->dataSize = frame->stride * part.height;
    cv::Mat target(part.size(), image.type(), frame->data);
    image(part).copyTo(target);
  }
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

}  // namespace rakelight
