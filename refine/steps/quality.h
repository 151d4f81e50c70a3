// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a user should know before trusting a result: pixels few lamps reach, images and depth frames that do not fit the
// others, ambient light that drifted. Measures go to result.json, doubts become warnings of one sentence.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "refine/problem.h"
#include "refine/surface_state.h"

namespace rakelight {

/// Images that light each pixel: the sum of the samples' trust, 0 to the number of images. Three are needed.
Eigen::VectorXd lit_images(const Observations& images, const SurfaceState& state);

struct QualityReport {
  std::map<std::string, double> measures;
  std::vector<std::string> warnings;
};

QualityReport assess_quality(const RefineProblem& problem, const SurfaceState& state);

/// Doubts about the recording itself, before any refinement: ambient light that differs between dark frames, depth
/// frames that lie apart from the others.
std::vector<std::string> recording_warnings(const LightStack& stack, const SensorDepth& sensor);

}  // namespace rakelight
