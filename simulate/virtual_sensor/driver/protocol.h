// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a program talks to our OpenNI2 driver beyond what OpenNI2 has words for: addresses, and private properties that
// openni::Device::setProperty and openni::VideoStream::setProperty hand through. Constants only: nothing to link.
#pragma once

#include <cstdint>

namespace rakelight::driver_protocol {

/// A virtual sensor that looks at a simulated scene under virtual lamps. It is found by this address only, never by search.
/// Any address that begins so is a virtual rig.
constexpr const char* kVirtualUri = "rakelight-virtual";
/// A device whose frames the program itself hands in, so that OpenNI2's recorder can write them.
constexpr const char* kFeedUri = "rakelight-feed";

/// Device, text: what the device shall be. Virtual: JSON as virtual_sensor/setup.h says; the scene is rendered before
/// the call returns. Feed: FeedSetup. Not while a stream runs.
constexpr int kSetup = 0x1D270002;
/// Virtual device, a byte a lamp (0 off, 1 on) in the setup's order. Set: the lines' levels from now on. Get: which
/// lamps give light now, which is another thing where they have faults.
constexpr int kLamps = 0x1D270001;
/// Feed stream, PushedFrame: goes through as a frame of the stream at once.
constexpr int kPushFrame = 0x1D270003;

/// Virtual device, get, TruthBuffers: they are filled with what the colour camera really has before it, on the grid of the
/// setup's colour images.
constexpr int kTruth = 0x1D270004;

struct TruthLamp {
  double direction[3], strength[3];  ///< as LampTruth
};
struct TruthBuffers {
  float *depth, *normals, *albedo;  ///< 1, 3 and 3 numbers a pixel, rows without gaps
  TruthLamp* lamps;                 ///< in the setup's order
};
struct FeedStream {
  std::int32_t width, height;
  float horizontal_fov, vertical_fov;  ///< radians
};
struct FeedSetup {
  FeedStream color, depth;
};
struct PushedFrame {
  const void* pixels;  ///< rows without gaps: R, G, B bytes, or 16-bit depth in units of 100 um
  std::int32_t index;
  std::uint64_t timestamp_us;
};

}  // namespace rakelight::driver_protocol
