// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The virtual sensor's depth stream.
#pragma once

#include "simulate/virtual_sensor/driver/timed_stream.h"

namespace rakelight {

/// The depth camera stands this far to the right of the colour camera. Registration undoes it.
constexpr double kDepthCameraX_m = 0.025;

std::vector<OniVideoMode> depth_modes(cv::Size preferred);

class DepthStream : public TimedStream {
 public:
  explicit DepthStream(std::shared_ptr<VirtualRigState> rig);
  ~DepthStream() override { stop(); }

 private:
  void prepare() override;
  double span_us() override;
  cv::Mat make_frame(int n, double start_us) override;

  std::shared_ptr<const DepthSensor> sensor_;
  std::vector<cv::Mat1w> frames_;  ///< registered, units of 100 um
};

/// Depth (units of 100 um) as the depth camera sees it, from depth as the colour camera would: nearest surface wins.
cv::Mat1w seen_from_depth_camera(const cv::Mat1w& registered, double focal_px);

}  // namespace rakelight
