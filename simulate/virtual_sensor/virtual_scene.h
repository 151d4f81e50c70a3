// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the virtual sensor looks at, rendered once: an image of each lamp's light alone, and the depth.
#pragma once

#include <memory>

#include "simulate/depth_sensor.h"
#include "simulate/virtual_sensor/setup.h"

namespace rakelight {

/// Linear light a source, for an exposure of kReferenceExposureUs at kReferenceGain; 1 = full scale, crosstalk included.
struct LampImages {
  cv::Mat3f ambient;
  std::vector<cv::Mat3f> lamps;  ///< runs parallel to VirtualSensorSetup::lamps
  cv::Mat3f albedo;              ///< of the paint, mean over a pixel; NaN where there is none
};

constexpr double kReferenceExposureUs = 8000;  ///< one lamp alone then lets about 0.2 % of the object clip
constexpr double kReferenceGain = 100;

class VirtualScene {
 public:
  /// @throws std::runtime_error when the scene cannot be built.
  explicit VirtualScene(const VirtualSensorSetup& setup);
  ~VirtualScene();
  VirtualScene(const VirtualScene&) = delete;
  VirtualScene& operator=(const VirtualScene&) = delete;

  LampImages render_color(cv::Size size) const;
  /// Depth and colour share one viewpoint.
  DepthSensor depth_sensor(cv::Size size) const;
  /// What `rakelight evaluate` compares with, on the grid of the images. Lamps are those of the rig.
  GroundTruth truth(const LampImages& images) const;

  const SimulateOptions& options() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rakelight
