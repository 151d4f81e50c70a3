// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The virtual sensor's colour stream: a rolling shutter under the virtual lamps, with automatic exposure and white balance
// that must be switched off for a scan.
#pragma once

#include "simulate/virtual_sensor/driver/timed_stream.h"

namespace rakelight {

std::vector<OniVideoMode> color_modes(cv::Size preferred);

class ColorStream : public TimedStream {
 public:
  explicit ColorStream(std::shared_ptr<VirtualRigState> rig);
  ~ColorStream() override { stop(); }

  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;

 private:
  void prepare() override;
  double span_us() override;
  cv::Mat make_frame(int n, double start_us) override;
  RollingShutter shutter() const;
  OniStatus set_camera(int id, int value);
  void adjust(const cv::Mat3b& image);

  std::shared_ptr<const FrameRenderer> renderer_;
  std::mutex camera_mutex_;
  Exposure set_;       ///< holds from the next frame on
  Exposure exposing_;  ///< of the frame that is being exposed; the stream's thread only
  bool auto_exposure_ = true, auto_white_balance_ = true;
};

}  // namespace rakelight
