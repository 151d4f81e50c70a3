// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/virtual_sensor/driver/depth_stream.h"

#include <cmath>

#include "simulate/depth_sensor.h"

namespace rakelight {
namespace {

constexpr double kUnit_m = 1e-4;
constexpr std::size_t kFrames = 12;  // made when they are first due, then delivered in turn

}  // namespace

std::vector<OniVideoMode> depth_modes(cv::Size preferred) {
  std::vector<OniVideoMode> modes;
  for (const OniPixelFormat format : {ONI_PIXEL_FORMAT_DEPTH_100_UM, ONI_PIXEL_FORMAT_DEPTH_1_MM}) {
    modes.push_back({format, preferred.width, preferred.height, 30});
    for (const int width : {320, 640}) {
      if (width != preferred.width) modes.push_back({format, width, width * 3 / 4, 30});
    }
  }
  return modes;
}

cv::Mat1w seen_from_depth_camera(const cv::Mat1w& registered, double focal_px) {
  cv::Mat1w seen(registered.size(), std::uint16_t{0});
  for (int v = 0; v < seen.rows; ++v) {
    for (int u = 0; u < seen.cols; ++u) {
      const std::uint16_t raw = registered(v, u);
      if (raw == 0) continue;
      const auto column = static_cast<int>(std::lround(u - focal_px * kDepthCameraX_m / (raw * kUnit_m)));
      if (column < 0) continue;
      std::uint16_t& target = seen(v, column);
      if (target == 0 || raw < target) target = raw;
    }
  }
  return seen;
}

DepthStream::DepthStream(std::shared_ptr<VirtualRigState> rig)
    : TimedStream(ONI_SENSOR_DEPTH, depth_modes(rig->setup().depth_size),
                  field_of_view(structured_light_camera(rig->setup().depth_size)), rig) {}

void DepthStream::prepare() {
  std::shared_ptr<const DepthSensor> sensor = rig().depth(size());
  if (sensor == sensor_) return;
  sensor_ = std::move(sensor);
  frames_.assign(kFrames, {});
}

/// An infrared camera with a global shutter, read out as slowly as the colour camera is.
double DepthStream::span_us() { return rig().setup().readout_us; }

cv::Mat DepthStream::make_frame(int n, double) {
  const std::size_t k = static_cast<std::size_t>(n) % kFrames;
  if (frames_[k].empty()) frames_[k] = sensor_->frame(static_cast<int>(k));
  cv::Mat1w raw = frames_[k];
  if (!rig().registered()) raw = seen_from_depth_camera(raw, structured_light_camera(size()).fx);
  if (mode().pixelFormat == ONI_PIXEL_FORMAT_DEPTH_100_UM) return raw;
  cv::Mat1w millimetres;
  raw.convertTo(millimetres, CV_16U, 0.1);
  return millimetres;
}

}  // namespace rakelight
