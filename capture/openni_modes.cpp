// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture/openni_modes.h"

#include <cmath>
#include <vector>

#include "capture/openni_session.h"

namespace rakelight {
namespace {

std::string to_string(const openni::VideoMode& mode) {
  return std::to_string(mode.getResolutionX()) + "x" + std::to_string(mode.getResolutionY()) + "@" +
         std::to_string(mode.getFps());
}

bool fits(const openni::VideoMode& mode, openni::PixelFormat format, const StreamMode& wanted) {
  return mode.getPixelFormat() == format && mode.getResolutionX() == wanted.width &&
         mode.getResolutionY() == wanted.height && mode.getFps() == wanted.fps;
}

/// The device's mode that fits, in the order in which formats are preferred.
openni::VideoMode choose_mode(const openni::SensorInfo& info, const std::string& name,
                              const std::vector<openni::PixelFormat>& formats, const StreamMode& wanted) {
  const auto& modes = info.getSupportedVideoModes();
  for (const openni::PixelFormat format : formats) {
    for (int k = 0; k < modes.getSize(); ++k) {
      if (fits(modes[k], format, wanted)) return modes[k];
    }
  }
  std::string known;
  for (int k = 0; k < modes.getSize(); ++k) {
    for (const openni::PixelFormat format : formats) {
      if (modes[k].getPixelFormat() == format) known += (known.empty() ? "" : ", ") + to_string(modes[k]);
    }
  }
  throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                          "the sensor has no " + name + " mode " + std::to_string(wanted.width) + "x" +
                              std::to_string(wanted.height) + "@" + std::to_string(wanted.fps) +
                              "; write one of these into the rig file: " + known);
}

}  // namespace

void create_stream(openni::Device& device, openni::SensorType type, const StreamMode& wanted,
                   openni::VideoStream& stream) {
  const bool color = type == openni::SENSOR_COLOR;
  const std::string name = color ? "colour" : "depth";
  const openni::SensorInfo* info = device.getSensorInfo(type);
  if (info == nullptr || stream.create(device, type) != openni::STATUS_OK) {
    throw openni_error(std::errc::no_such_device, "the sensor has no " + name + " stream",
                       "use an RGB-D sensor");
  }
  const std::vector<openni::PixelFormat> formats =
      color ? std::vector<openni::PixelFormat>{openni::PIXEL_FORMAT_RGB888}
            : std::vector<openni::PixelFormat>{openni::PIXEL_FORMAT_DEPTH_100_UM,
                                               openni::PIXEL_FORMAT_DEPTH_1_MM};
  const openni::VideoMode mode = choose_mode(*info, name, formats, wanted);
  if (stream.setVideoMode(mode) != openni::STATUS_OK) {
    throw openni_error(std::errc::io_error, "cannot set the " + name + " mode " + to_string(mode),
                       "choose another in the rig file");
  }
  stream.setMirroringEnabled(false);  // some devices mirror by default; those that cannot, say so and do not
}

double depth_unit_m(openni::PixelFormat format) {
  if (format == openni::PIXEL_FORMAT_DEPTH_1_MM) return 1e-3;
  if (format == openni::PIXEL_FORMAT_DEPTH_100_UM) return 1e-4;
  throw std::system_error(std::make_error_code(std::errc::invalid_argument),
                          "depth comes as disparity, not in a unit of length; use a mode in millimetres");
}

Camera nominal_camera(const openni::VideoStream& stream) {
  const openni::VideoMode mode = stream.getVideoMode();
  const int width = mode.getResolutionX(), height = mode.getResolutionY();
  const auto focal = [](int pixels, float view) {
    return pixels / (2 * std::tan(static_cast<double>(view) / 2));
  };
  return {width,
          height,
          focal(width, stream.getHorizontalFieldOfView()),
          focal(height, stream.getVerticalFieldOfView()),
          (width - 1) / 2.0,
          (height - 1) / 2.0,
          {}};
}

}  // namespace rakelight
