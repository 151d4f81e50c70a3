// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <OpenNI.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "capture/oni_file.h"
#include "capture/openni_device.h"
#include "capture/openni_session.h"
#include "simulate/virtual_sensor/driver/protocol.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

constexpr double kUnit_m = 1e-4;  // of the recording's depth
constexpr double kPeriod_us = 1e6 / 30;

driver_protocol::FeedStream feed_of(const Camera& camera) {
  return {camera.width, camera.height, static_cast<float>(2 * std::atan(camera.width / 2.0 / camera.fx)),
          static_cast<float>(2 * std::atan(camera.height / 2.0 / camera.fy))};
}

/// A stream of the feed device, which delivers what it is given.
class FedStream {
 public:
  FedStream(OpenniDevice& device, openni::SensorType type, openni::Recorder& recorder) {
    // Lossy compression is on by default for colour.
    if (stream_.create(device.get(), type) != openni::STATUS_OK ||
        recorder.attach(stream_, false) != openni::STATUS_OK || stream_.start() != openni::STATUS_OK) {
      throw openni_error(std::errc::io_error, "cannot set up the recording", "see whether the disk is full");
    }
  }
  ~FedStream() { stream_.destroy(); }
  FedStream(const FedStream&) = delete;
  FedStream& operator=(const FedStream&) = delete;

  void push(const cv::Mat& image, const Timestamp& time, int k) {
    const cv::Mat whole = image.isContinuous() ? image : image.clone();
    const auto stamp = time.device_us.value_or(std::llround(k * kPeriod_us));
    const driver_protocol::PushedFrame frame{whole.data, k + 1, static_cast<std::uint64_t>(stamp)};
    if (stream_.setProperty(driver_protocol::kPushFrame, &frame, sizeof frame) != openni::STATUS_OK) {
      throw openni_error(std::errc::io_error, "cannot record a frame", "see whether the disk is full");
    }
  }

  void stop() { stream_.stop(); }

 private:
  openni::VideoStream stream_;
};

cv::Mat eight_bit(const cv::Mat& color) {
  cv::Mat result = color;
  if (color.depth() != CV_8U) color.convertTo(result, CV_8U, 1 / 257.0);
  return result;
}

cv::Mat1w recorded_depth(const LightStack& stack, const Frame& frame) {
  cv::Mat1w raw;
  frame.depth.convertTo(raw, CV_16U, stack.depth_unit_m / kUnit_m);
  return raw;
}

std::vector<const Frame*> frames_with_both(const LightStack& stack) {
  std::vector<const Frame*> frames;
  for (const Frame& frame : stack.frames) {
    if (!frame.color.empty() && !frame.depth.empty()) frames.push_back(&frame);
  }
  if (frames.empty()) {
    throw InputError(stack.origin, "has no frame with both colour and depth",
                     "scan with depth to make a recording");
  }
  return frames;
}

/// Pushes all frames, `pace` apart.
void record(const LightStack& stack, const std::vector<const Frame*>& frames,
            const std::filesystem::path& file, std::chrono::milliseconds pace) {
  OpenniDevice device(driver_protocol::kFeedUri);
  const driver_protocol::FeedSetup setup{feed_of(stack.color_camera), feed_of(stack.depth_camera)};
  device.set_property(driver_protocol::kSetup, &setup, sizeof setup);
  openni::Recorder recorder;
  if (recorder.create(file.c_str()) != openni::STATUS_OK) {
    throw IoError("cannot write " + file.string() + "; check folder and disk");
  }
  FedStream color(device, openni::SENSOR_COLOR, recorder), depth(device, openni::SENSOR_DEPTH, recorder);
  if (recorder.start() != openni::STATUS_OK)
    throw IoError("cannot write " + file.string() + "; check folder and disk");
  const auto push = [&](const Frame& frame, int k) {
    color.push(eight_bit(frame.color), frame.color_time, k);
    depth.push(recorded_depth(stack, frame), frame.depth_time, k);
    std::this_thread::sleep_for(pace);
  };
  push(*frames.front(), 0);  // the recorder swallows the first frame of each stream
  for (std::size_t k = 0; k < frames.size(); ++k) push(*frames[k], static_cast<int>(k) + 1);
  recorder.stop();
  recorder.destroy();
  color.stop();
  depth.stop();
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::norm(a, b, cv::NORM_INF) == 0;
}

/// Whether the file's pairs are these frames.
bool holds(const std::filesystem::path& file, const LightStack& stack,
           const std::vector<const Frame*>& frames) {
  try {
    const LightStack recorded = import_oni(file, {});
    return std::equal(frames.begin(), frames.end(), recorded.frames.begin(), recorded.frames.end(),
                      [&stack](const Frame* frame, const Frame& pair) {
                        return same(eight_bit(frame->color), pair.color) &&
                               same(recorded_depth(stack, *frame), pair.depth);
                      });
  } catch (const InputError&) { return false; }
}

}  // namespace

void export_oni(const LightStack& stack, const std::filesystem::path& file) {
  const std::vector<const Frame*> frames = frames_with_both(stack);
  // The recorder takes the newest frame of a stream when its own thread comes round, and does not say that it has; now and then
  // it does not swallow the first one, and depth lags behind colour from then on. So frames are pushed ever more slowly until
  // the file holds each beside its own.
  for (const int pace_ms : {5, 5, 20, 20, 80, 320}) {
    record(stack, frames, file, std::chrono::milliseconds(pace_ms));
    if (holds(file, stack, frames)) return;
  }
  throw IoError("cannot write all frames to " + file.string() + "; see whether the disk is full");
}

}  // namespace rakelight
