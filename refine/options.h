// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every parameter of the refinement, with its unit or equation.
#pragma once

#include <string>

namespace rakelight {

enum class Method { multi_light, rgb_ratio, fusion_like, rgbd_fusion };
enum class Preset { paper, robust };

/// Filling and smoothing of the sensor's depth before any method (Sec. III, first paragraph).
struct PreprocessOptions {
  double bilateral_sigma_px = 3.0;     ///< spatial reach of the bilateral filter, depth pixels
  double bilateral_sigma_noise = 4.0;  ///< range of the bilateral filter, in measured depth noise deviations
};

struct RefineOptions {
  Method method = Method::multi_light;
  Preset preset = Preset::robust;
  int scale = 0;           ///< refined grid / depth grid, 1 to 4; 0: as fine as the colour images are
  int max_iterations = 25; ///< outer iterations
  int threads = 0;         ///< 0: all; the result does not depend on it
  PreprocessOptions preprocess;
};

/// The defaults of a preset for a method.
RefineOptions preset_options(Preset preset, Method method = Method::multi_light);

std::string to_string(Method method);
std::string to_string(Preset preset);

}  // namespace rakelight
