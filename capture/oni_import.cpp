// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <OpenNI.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "capture/oni_file.h"
#include "capture/openni_modes.h"
#include "capture/openni_session.h"
#include "stack/errors.h"

namespace rakelight {
namespace {

const char* const kCure = "record colour (RGB888) and depth with OpenNI2, or check that the file is whole";

class Recording {
 public:
  explicit Recording(const std::filesystem::path& file) : file_(file) {
    if (!std::filesystem::is_regular_file(file))
      throw InputError(file.string(), "no such file", "check the path");
    if (device_.open(file.c_str()) != openni::STATUS_OK || device_.getPlaybackControl() == nullptr)
      refuse("is no OpenNI2 recording");
    if (color_.create(device_, openni::SENSOR_COLOR) != openni::STATUS_OK) refuse("has no colour stream");
    if (depth_.create(device_, openni::SENSOR_DEPTH) != openni::STATUS_OK) refuse("has no depth stream");
    if (color_.getVideoMode().getPixelFormat() != openni::PIXEL_FORMAT_RGB888)
      refuse("has colour in another format than RGB888");
    device_.getPlaybackControl()->setSpeed(-1);  // a frame a read, none is lost
    device_.getPlaybackControl()->setRepeatEnabled(false);
    color_.start();
    depth_.start();
  }
  /// Streams that are destroyed while they run crash the library's player now and then.
  ~Recording() {
    color_.stop();
    depth_.stop();
    color_.destroy();
    depth_.destroy();
    device_.close();
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// Pairs that both streams hold. Reading further has no time-out: it would wait for ever.
  int pairs() {
    openni::PlaybackControl& playback = *device_.getPlaybackControl();
    return std::min(playback.getNumberOfFrames(color_), playback.getNumberOfFrames(depth_));
  }

  /// Streams must be read strictly in turn.
  Frame read_pair(int index) {
    Frame frame;
    frame.index = index;
    frame.color = read(color_, CV_8UC3, frame.color_time);
    frame.depth = read(depth_, CV_16UC1, frame.depth_time);
    return frame;
  }

  LightStack empty_stack() {
    const openni::DeviceInfo& info = device_.getDeviceInfo();
    LightStack stack;
    stack.sensor = {info.getVendor(), info.getName(), file_.filename().string(), "", "OpenNI2 recording"};
    stack.color_camera = nominal_camera(color_);
    stack.depth_camera = nominal_camera(depth_);
    stack.depth_unit_m = depth_unit_m(depth_.getVideoMode().getPixelFormat());
    stack.color_response.kind =
        ColorResponse::Kind::srgb;  // unknown; what cameras of this kind come nearest to
    stack.origin = file_.string();
    return stack;
  }

 private:
  [[noreturn]] void refuse(const std::string& fault) const { throw InputError(file_.string(), fault, kCure); }

  cv::Mat read(openni::VideoStream& stream, int type, Timestamp& time) {
    openni::VideoStream* streams[]{&stream};
    int ready = -1;
    openni::VideoFrameRef frame;
    if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, kReadLimit_ms) != openni::STATUS_OK ||
        stream.readFrame(&frame) != openni::STATUS_OK) {
      refuse("ends before the number of frames that it announces");
    }
    time.device_us = static_cast<std::int64_t>(frame.getTimestamp());
    return cv::Mat(frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
                   static_cast<std::size_t>(frame.getStrideInBytes()))
        .clone();
  }

  static constexpr int kReadLimit_ms = 5000;

  OpenniSession session_;
  const std::filesystem::path file_;
  openni::Device device_;
  openni::VideoStream color_, depth_;
};

std::string light_of(const OniImportOptions& options, int k) {
  if (!options.lights.empty()) return options.lights[static_cast<std::size_t>(k)];
  char id[32];
  std::snprintf(id, sizeof id, "frame-%04d", k);
  return id;
}

LampColor color_of(const std::string& id) {
  for (const LampColor color : {LampColor::red, LampColor::green, LampColor::blue, LampColor::rgb}) {
    if (id == to_string(color)) return color;
  }
  return LampColor::white;
}

void add_frame(const std::string& light, Frame frame, std::set<std::string>& known, LightStack& stack) {
  if (light != "dark") {
    if (known.insert(light).second) stack.lights.push_back({light, color_of(light), {}, {}});
    frame.light = light;
  }
  stack.frames.push_back(std::move(frame));
}

}  // namespace

LightStack import_oni(const std::filesystem::path& file, const OniImportOptions& options) {
  Recording recording(file);
  LightStack stack = recording.empty_stack();
  const int available = recording.pairs() / options.every;
  const int wanted = options.lights.empty() ? available : static_cast<int>(options.lights.size());
  if (available == 0) throw InputError(file.string(), "holds no pair of colour and depth frames", kCure);
  if (wanted > available) {
    throw InputError(file.string(),
                     "holds " + std::to_string(available) + " pairs of frames, but " +
                         std::to_string(wanted) + " lights are listed",
                     "shorten the list");
  }
  std::set<std::string> known;
  for (int k = 0; k < wanted; ++k) {
    add_frame(light_of(options, k), recording.read_pair(k), known, stack);
    for (int skipped = 1; skipped < options.every; ++skipped) recording.read_pair(k);
  }
  return stack;
}

}  // namespace rakelight
