// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What every stream of our OpenNI2 driver answers: modes, field of view, cropping.
#pragma once

#include <cstring>
#include <mutex>
#include <opencv2/core.hpp>
#include <vector>

#include "simulate/virtual_sensor/driver/oni_driver_api.h"
#include "stack/stack.h"

namespace rakelight {

struct FieldOfView {
  float horizontal = 0, vertical = 0;  ///< radians
};
FieldOfView field_of_view(const Camera& camera);

/// Answers a property of type Value.
template <class Value>
OniStatus answer(const Value& value, void* data, int* size) {
  if (*size < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
  std::memcpy(data, &value, sizeof value);
  *size = static_cast<int>(sizeof value);
  return ONI_STATUS_OK;
}

/// Reads a property of type Value; false if its size is another.
template <class Value>
bool accept(Value& value, const void* data, int size) {
  if (size != static_cast<int>(sizeof value)) return false;
  std::memcpy(&value, data, sizeof value);
  return true;
}

class SensorStream : public oni::driver::StreamBase {
 public:
  /// The first mode is the one set.
  SensorStream(OniSensorType type, std::vector<OniVideoMode> modes, FieldOfView view);

  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;

 protected:
  OniVideoMode mode() const;
  cv::Size size() const;
  /// Hands a copy of the image (of mode()'s size) to the library, cropped as asked.
  void deliver(const cv::Mat& image, int index, std::uint64_t timestamp_us);

 private:
  OniStatus set_mode(const OniVideoMode& mode);
  OniStatus set_cropping(const OniCropping& cropping);
  cv::Rect visible_part() const;

  const OniSensorType type_;
  const std::vector<OniVideoMode> modes_;
  const FieldOfView view_;
  mutable std::mutex mutex_;
  OniVideoMode mode_;
  OniCropping cropping_{};
};

}  // namespace rakelight
