// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_source.h"

#include <OpenNI.h>

#include <cmath>
#include <cstring>

#include "capture/frame_queue.h"
#include "capture/openni_device.h"
#include "capture/openni_modes.h"

namespace rakelight {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kQueuedFrames = 60;       // two seconds
constexpr milliseconds kStallLimit{1500};       // an unplugged sensor is reported within 2 s
constexpr milliseconds kFirstFrameLimit{5000};  // devices warm up

std::int64_t host_now_us() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(now).count();
}

SensorFrame copy_of(const openni::VideoFrameRef& frame, int type) {
  SensorFrame copy;
  copy.host_us = host_now_us();
  copy.index = frame.getFrameIndex();
  copy.device_us = static_cast<std::int64_t>(frame.getTimestamp());
  // OpenCV has no view of constant memory; it is only copied from.
  copy.image = cv::Mat(frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
                       static_cast<std::size_t>(frame.getStrideInBytes()))
                   .clone();
  return copy;
}

/// A stream whose frames go to a queue as they come.
class QueuedStream : openni::VideoStream::NewFrameListener {
 public:
  QueuedStream(openni::Device& device, openni::SensorType type, const StreamMode& mode)
      : queue(type == openni::SENSOR_COLOR ? "colour" : "depth", kQueuedFrames, kStallLimit),
        pixel_type_(type == openni::SENSOR_COLOR ? CV_8UC3 : CV_16UC1) {
    create_stream(device, type, mode, stream);
  }
  ~QueuedStream() override { stream.destroy(); }
  QueuedStream(const QueuedStream&) = delete;
  QueuedStream& operator=(const QueuedStream&) = delete;

  void start() {
    queue.reset();
    stream.addNewFrameListener(this);
    if (stream.start() == openni::STATUS_OK) return;
    stream.removeNewFrameListener(this);
    throw openni_error(std::errc::io_error, "cannot start a stream of the sensor",
                       "close other programs that use it, or plug it in again");
  }

  void stop() {
    stream.removeNewFrameListener(this);
    stream.stop();
  }

  openni::VideoStream stream;
  FrameQueue queue;

 private:
  void onNewFrame(openni::VideoStream& ready) override {
    openni::VideoFrameRef frame;
    if (ready.readFrame(&frame) == openni::STATUS_OK && frame.isValid())
      queue.push(copy_of(frame, pixel_type_));
  }

  const int pixel_type_;
};

class OpenniSource : public FrameSource, openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit OpenniSource(const Rig& rig)
      : device_(open_openni_device(rig)),
        uri_(device_->get().getDeviceInfo().getUri()),
        color_(device_->get(), openni::SENSOR_COLOR, rig.sensor.color),
        depth_(device_->get(), openni::SENSOR_DEPTH, rig.sensor.depth) {
    describe_device(rig.calibration);
    openni::OpenNI::addDeviceDisconnectedListener(this);
  }

  ~OpenniSource() override {
    openni::OpenNI::removeDeviceDisconnectedListener(this);
    stop();
  }

  SourceDescription describe() const override { return description_; }
  void start() override;
  void stop() override;
  std::optional<SensorFrame> next(Stream stream, milliseconds timeout) override {
    return queue(stream).pop(timeout);
  }
  int overruns(Stream stream) const override {
    return (stream == Stream::color ? color_ : depth_).queue.overruns();
  }
  ExposureLock lock_exposure(double exposure_us, double gain) override;

 private:
  FrameQueue& queue(Stream stream) { return (stream == Stream::color ? color_ : depth_).queue; }
  void describe_device(const RigCalibration& calibration);
  bool register_depth(const RigCalibration& calibration);
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;

  std::unique_ptr<OpenniDevice> device_;
  std::string uri_;
  QueuedStream color_, depth_;
  SourceDescription description_;
  bool running_ = false;
};

/// The device's own registration, unless a calibration of the unregistered cameras is at hand.
bool OpenniSource::register_depth(const RigCalibration& calibration) {
  openni::Device& device = device_->get();
  const openni::ImageRegistrationMode mode =
      calibration.T_color_depth ? openni::IMAGE_REGISTRATION_OFF : openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (!device.isImageRegistrationModeSupported(mode)) return false;
  return device.setImageRegistrationMode(mode) == openni::STATUS_OK &&
         device.getImageRegistrationMode() == openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
}

void OpenniSource::describe_device(const RigCalibration& calibration) {
  openni::Device& device = device_->get();
  const openni::DeviceInfo& info = device.getDeviceInfo();
  char serial[ONI_MAX_STR] = "";
  int size = sizeof serial - 1;
  device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, serial, &size);  // not every device has one
  const openni::Version version = openni::OpenNI::getVersion();
  description_.sensor = {info.getVendor(), info.getName(), uri_, serial,
                         "OpenNI2 " + std::to_string(version.major) + "." + std::to_string(version.minor)};
  description_.color_camera = calibration.color_camera.value_or(nominal_camera(color_.stream));
  description_.depth_camera = calibration.depth_camera.value_or(nominal_camera(depth_.stream));
  description_.depth_unit_m = depth_unit_m(depth_.stream.getVideoMode().getPixelFormat());
  description_.frame_period_us = 1e6 / color_.stream.getVideoMode().getFps();
  description_.depth_registered_to_color = register_depth(calibration);
  if (description_.depth_registered_to_color) {
    const int width = depth_.stream.getVideoMode().getResolutionX();
    description_.depth_camera =
        binned(description_.color_camera, 1.0 * description_.color_camera.width / width);
  } else if (calibration.T_color_depth) {
    description_.T_color_depth = *calibration.T_color_depth;
  }
}

void OpenniSource::onDeviceDisconnected(const openni::DeviceInfo* info) {
  if (uri_ != info->getUri()) return;
  color_.queue.mark_lost();
  depth_.queue.mark_lost();
}

void OpenniSource::start() {
  if (running_) return;
  running_ = true;
  color_.start();
  depth_.start();
  if (!color_.queue.wait(kFirstFrameLimit) || !depth_.queue.wait(kFirstFrameLimit)) {
    stop();
    throw SensorLost("the sensor " + uri_ + " sends no frames; plug it in again, on another port");
  }
}

void OpenniSource::stop() {
  if (!running_) return;
  running_ = false;
  color_.stop();
  depth_.stop();
}

ExposureLock OpenniSource::lock_exposure(double exposure_us, double gain) {
  ExposureLock lock;
  openni::CameraSettings* camera = color_.stream.getCameraSettings();
  if (camera == nullptr) return lock;  // the device has no such settings, or does not tell
  camera->setAutoExposureEnabled(false);
  camera->setAutoWhiteBalanceEnabled(false);
  camera->setExposure(static_cast<int>(std::lround(exposure_us)));
  camera->setGain(static_cast<int>(std::lround(gain)));
  lock.auto_exposure_off = !camera->getAutoExposureEnabled();
  lock.auto_white_balance_off = !camera->getAutoWhiteBalanceEnabled();
  const int exposure_read = camera->getExposure(), gain_read = camera->getGain();
  if (exposure_read > 0) lock.exposure_us = exposure_read;
  if (gain_read > 0) lock.gain = gain_read;
  return lock;
}

}  // namespace

std::unique_ptr<FrameSource> open_openni_source(const Rig& rig) {
  return std::make_unique<OpenniSource>(rig);
}

}  // namespace rakelight
