// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/replay_source.h"

#include <cmath>

namespace rakelight {
namespace {

class ReplaySource : public FrameSource {
 public:
  explicit ReplaySource(LightStack stack) : stack_(std::move(stack)) {}

  SourceDescription describe() const override {
    SourceDescription description;
    description.sensor = stack_.sensor;
    description.color_camera = stack_.color_camera;
    description.depth_camera = stack_.depth_camera;
    description.T_color_depth = stack_.T_color_depth;
    description.depth_unit_m = stack_.depth_unit_m;
    description.depth_registered_to_color = stack_.T_color_depth.isIdentity();
    description.live = false;
    return description;
  }

  void start() override { next_[0] = next_[1] = 0; }
  void stop() override {}
  int overruns(Stream) const override { return 0; }

  std::optional<SensorFrame> next(Stream stream, std::chrono::milliseconds) override {
    std::size_t& k = next_[stream == Stream::color ? 0 : 1];
    while (k < stack_.frames.size()) {
      const Frame& frame = stack_.frames[k++];
      const cv::Mat image = stream == Stream::color ? frame.color : cv::Mat(frame.depth);
      if (!image.empty())
        return sensor_frame(frame, image, stream == Stream::color ? frame.color_time : frame.depth_time);
    }
    return std::nullopt;
  }

  /// What the stack was taken with cannot be changed any more.
  ExposureLock lock_exposure(double, double) override {
    return {stack_.exposure_us, stack_.gain, true, true};
  }

 private:
  SensorFrame sensor_frame(const Frame& frame, const cv::Mat& image, const Timestamp& time) const {
    const std::int64_t nominal_us = std::llround(frame.index * SourceDescription().frame_period_us);
    const std::int64_t device_us = time.device_us.value_or(nominal_us);
    cv::Mat pixels;
    image.convertTo(pixels, image.type() == CV_16UC3 ? CV_8U : -1,
                    image.type() == CV_16UC3 ? 1 / 257.0 : 1.0);
    return {pixels, frame.index, device_us, time.host_us.value_or(device_us)};
  }

  const LightStack stack_;
  std::size_t next_[2] = {0, 0};
};

}  // namespace

std::unique_ptr<FrameSource> open_replay_source(LightStack stack) {
  return std::make_unique<ReplaySource>(std::move(stack));
}

}  // namespace rakelight
