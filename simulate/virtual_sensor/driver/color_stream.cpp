// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/color_stream.h"

#include <algorithm>
#include <cmath>

#include "simulate/depth_sensor.h"

namespace rakelight {
namespace {

constexpr double kTargetMean = 90;    // of what is not black, that automatic exposure steers to
constexpr double kFastestStep = 1.2;  // factor a frame
constexpr double kLeastGain = 25, kMostGain = 1600;
constexpr double kShortestExposureUs = 100;

double limited_step(double factor) { return std::clamp(factor, 1 / kFastestStep, kFastestStep); }

}  // namespace

std::vector<OniVideoMode> color_modes(cv::Size preferred) {
  std::vector<OniVideoMode> modes{{ONI_PIXEL_FORMAT_RGB888, preferred.width, preferred.height, 30}};
  for (const int width : {320, 640, 1280}) {
    if (width != preferred.width) modes.push_back({ONI_PIXEL_FORMAT_RGB888, width, width * 3 / 4, 30});
  }
  return modes;
}

ColorStream::ColorStream(std::shared_ptr<VirtualRigState> rig)
    : TimedStream(ONI_SENSOR_COLOR, color_modes(rig->setup().color_size),
                  field_of_view(structured_light_camera(rig->setup().color_size)), rig) {}

void ColorStream::prepare() { renderer_ = rig().color(size()); }

RollingShutter ColorStream::shutter() const {
  return {size().height, exposing_.exposure_us, rig().setup().readout_us};
}

double ColorStream::span_us() {
  const std::lock_guard<std::mutex> lock(camera_mutex_);
  exposing_ = set_;
  if (rig().setup().ignores_exposure)
    exposing_.exposure_us = kReferenceExposureUs, exposing_.gain = kReferenceGain;
  return shutter().span_us();
}

cv::Mat ColorStream::make_frame(int n, double start_us) {
  cv::Mat3b image;
  renderer_->render(rig().light(shutter(), start_us), exposing_, n, image);
  adjust(image);
  return image;
}

/// Automatic exposure steers the mean of what is seen by the gain; automatic white balance makes it grey.
void ColorStream::adjust(const cv::Mat3b& image) {
  const std::lock_guard<std::mutex> lock(camera_mutex_);
  if (!auto_exposure_ && !auto_white_balance_) return;
  cv::Mat1b seen;
  cv::inRange(image, cv::Scalar::all(0), cv::Scalar::all(3), seen);
  const cv::Scalar mean = cv::mean(image, seen == 0);
  if (mean[0] <= 0 || mean[1] <= 0 || mean[2] <= 0) return;
  if (auto_exposure_) {
    set_.gain = std::clamp(set_.gain * limited_step(kTargetMean / mean[1]), kLeastGain, kMostGain);
  }
  if (!auto_white_balance_) return;
  for (const int c : {0, 2}) set_.white_balance[c] *= static_cast<float>(limited_step(mean[1] / mean[c]));
}

OniStatus ColorStream::set_camera(int id, int value) {
  const std::lock_guard<std::mutex> lock(camera_mutex_);
  if (id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE) {
    auto_exposure_ = value != 0;
  } else if (id == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE) {
    auto_white_balance_ = value != 0;
    if (!auto_white_balance_) set_.white_balance = {1, 1, 1};
  } else if (auto_exposure_) {
    return ONI_STATUS_ERROR;  // as cameras do: switch it off first
  } else if (id == ONI_STREAM_PROPERTY_EXPOSURE) {
    set_.exposure_us = std::clamp<double>(value, kShortestExposureUs, rig().setup().frames.period_us);
  } else {
    set_.gain = std::clamp<double>(value, kLeastGain, kMostGain);
  }
  return ONI_STATUS_OK;
}

OniStatus ColorStream::setProperty(int id, const void* data, int size) {
  if (id < ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE || id > ONI_STREAM_PROPERTY_GAIN) {
    return SensorStream::setProperty(id, data, size);
  }
  int value = 0;
  return accept(value, data, size) ? set_camera(id, value) : ONI_STATUS_BAD_PARAMETER;
}

OniStatus ColorStream::getProperty(int id, void* data, int* size) {
  const std::lock_guard<std::mutex> lock(camera_mutex_);
  switch (id) {
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return answer(OniBool{auto_exposure_}, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return answer(OniBool{auto_white_balance_}, data, size);
    case ONI_STREAM_PROPERTY_EXPOSURE:
      return answer(static_cast<int>(std::lround(set_.exposure_us)), data, size);
    case ONI_STREAM_PROPERTY_GAIN:
      return answer(static_cast<int>(std::lround(set_.gain)), data, size);
    default:
      return SensorStream::getProperty(id, data, size);
  }
}

OniBool ColorStream::isPropertySupported(int id) {
  const bool camera = id >= ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE && id <= ONI_STREAM_PROPERTY_GAIN;
  return camera ? TRUE : SensorStream::isPropertySupported(id);
}

}  // namespace rakelight
