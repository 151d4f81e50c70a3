// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nouns every room shares: camera, light, frame, light stack. Read this header first.
//
// Frames of reference: camera coordinates are x right, y down, z forward, in metres. Pixel (u, v) has its
// centre at integer coordinates, so the image spans [-0.5, width - 0.5].
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rakelight {

/// Pinhole camera. Lengths in pixels; distortion in OpenCV's order (k1 k2 p1 p2 k3 k4 k5 k6), empty for none.
struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0, fy = 0;  ///< focal lengths
  double cx = 0, cy = 0;  ///< principal point
  std::vector<double> distortion;

  cv::Size size() const { return {width, height}; }
};

/// The same camera seen on a grid whose pixels are blocks of `factor` x `factor` pixels of this one
/// (a factor below 1 gives a finer grid). Block centres map to pixel centres.
Camera binned(const Camera& camera, double factor);

enum class LampColor { red, green, blue, white, rgb };
std::string to_string(LampColor color);

/// One lamp state of the rig: a single LED, or red, green and blue together (`rgb`).
struct Light {
  std::string id;
  LampColor color = LampColor::white;
  std::optional<int> line;                    ///< GPIO line offset, if known
  std::optional<Eigen::Vector3d> position_m;  ///< in colour-camera coordinates, if measured
};

/// Device and host clocks of one event, in microseconds; empty where the source does not tell.
struct Timestamp {
  std::optional<std::int64_t> device_us;
  std::optional<std::int64_t> host_us;
};

/// Proof of which lamp was on: mean linear RGB of the top, middle and bottom rows, ambient subtracted.
struct LitCheck {
  std::array<std::array<double, 3>, 3> rows_rgb{};
  bool matches = false;  ///< agrees with the lamp's learnt signature
};

/// One exposure. `light` is empty for a dark frame (ambient light only).
struct Frame {
  int index = 0;
  std::optional<std::string> light;  ///< id in LightStack::lights
  cv::Mat
      color;  ///< CV_8UC3 or CV_16UC3, channels R, G, B, encoded by LightStack::color_response; may be empty
  cv::Mat1w depth;  ///< raw sensor units (metres = raw * depth_unit_m), 0 = no reading; may be empty
  Timestamp color_time, depth_time, led_edge_time;
  std::optional<LitCheck> lit_check;
  /// Decodes `color` anew at every call, where it is left on the disk (open_stack); else empty. Safe from several threads.
  std::function<cv::Mat()> read_color;
};

/// Whether the frame has a colour image, in memory or on the disk.
bool has_color(const Frame& frame);

/// The frame with its colour image in memory, as all functions that look at Frame::color want it.
/// @throws what Frame::read_color throws
Frame with_color(const Frame& frame);

/// Where a reader leaves the colour images: most of what a stack takes.
enum class Colors { in_memory, on_disk };

/// How a colour value in [0, 1] encodes radiance: linear, the sRGB curve, or value = radiance^(1/gamma).
struct ColorResponse {
  enum class Kind { linear, srgb, gamma };
  Kind kind = Kind::linear;
  double gamma = 1.0;  ///< used by Kind::gamma
};

struct Sensor {
  std::string vendor, name, uri, serial, driver;
};

struct WhiteBalance {
  double red = 1, green = 1, blue = 1;
};

/// What a scan records: one colour image a lamp, depth frames, the cameras and the lamps.
struct LightStack {
  std::string created;  ///< RFC 3339
  Sensor sensor;
  Camera color_camera, depth_camera;
  Eigen::Matrix4d T_color_depth = Eigen::Matrix4d::Identity();  ///< depth to colour coordinates, metres
  double depth_unit_m = 0.001;
  ColorResponse color_response;
  /// Column k: what a unit of light of LED colour k (R, G, B) leaves in the sensor's channels. Undone on linearising.
  Eigen::Matrix3d color_crosstalk = Eigen::Matrix3d::Identity();
  std::optional<double> exposure_us, gain;
  std::optional<WhiteBalance> white_balance;
  std::vector<Light> lights;
  std::vector<Frame> frames;
  cv::Mat1b mask;            ///< colour or depth size; 255 = object; empty: every pixel with depth
  std::string origin;        ///< the folder it was read from (for messages), or empty
  std::string unknown_keys;  ///< manifest keys this version does not know, as JSON text: kept on writing
};

/// The stack with all its colour images in memory. @throws what Frame::read_color throws
LightStack in_memory(LightStack stack);

/// A lamp as it truly is. A unit of `strength` gives a facing surface of albedo 1 a radiance of 1 (encoded full scale):
/// far lamps everywhere, near lamps at the distance of the object's centre.
struct LampTruth {
  std::string id;  ///< as in LightStack::lights
  LampColor color = LampColor::white;
  bool near = false;
  std::optional<Eigen::Vector3d> position_m;            ///< camera coordinates; near lamps only
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, from the object's centre towards the lamp
  Eigen::Vector3d strength = Eigen::Vector3d::Zero();   ///< linear RGB
};

/// The right answer, from `simulate` or a laboratory scanner; NaN outside the object.
struct GroundTruth {
  cv::Mat1f depth;               ///< metres
  cv::Mat3f normals;             ///< camera frame, unit length, n_z < 0 faces the camera; channels x, y, z
  cv::Mat3f albedo;              ///< linear RGB; may be empty
  std::vector<LampTruth> lamps;  ///< truth/lamps.json; may be empty
};

}  // namespace rakelight
