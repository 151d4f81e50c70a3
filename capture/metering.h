// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exposure from pictures: as bright as can be with under 1 % of the object saturated under any lamp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "capture/coarse_scene.h"

namespace rakelight {

struct ExposureSetting {
  double time_us = 8000;
  double gain = 100;
};

struct MeteringLimits {
  double max_saturated = 0.01;  ///< share of the object's area, under any lamp
  double dimmest = 0.3;         ///< linear level the brightest lamp must reach at least
  double target = 0.7;          ///< level that is aimed for when it does not
  double min_time_us = 1000, max_time_us = 32000;
  double max_gain_factor = 4;  ///< of the gain in the rig file
};

/// What the pictures of all lamps say of an exposure.
struct Brightness {
  double saturated = 0;  ///< of the lamp that saturates most: share of the object's area
  double level =
      0;  ///< of the brightest lamp: linear value below which 99 % of the object lies in its brightest channel
};

/// @param object 255: cells that count  @param lit colour images, one a lamp
Brightness measure_brightness(const CoarseScene& scene, const cv::Mat1b& object,
                              const std::vector<cv::Mat>& lit, const ColorResponse& response);

/// The exposure to try next; nothing if this one is right or cannot be bettered. Time is changed before gain.
std::optional<ExposureSetting> better_exposure(const Brightness& seen, const ExposureSetting& now,
                                               const ExposureSetting& start, const MeteringLimits& limits);

}  // namespace rakelight
