// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A bump on a plane as a finished refinement: the start is the plane, the refined depth has the bump.
#pragma once

#include <cmath>

#include "refine/depth_normals.h"
#include "refine/refine.h"
#include "viewer/scene.h"

namespace rakelight::test {

inline constexpr int kBumpWidth = 160, kBumpHeight = 120;
inline constexpr float kPlaneM = 0.5f, kBumpM = 0.02f;  ///< distance of the plane, height of the bump

inline RefineResult bump_result() {
  const cv::Size size(kBumpWidth, kBumpHeight);
  RefineResult result;
  result.camera = {size.width, size.height, 200.0, 200.0, 79.5, 59.5, {}};
  result.initial_depth = cv::Mat1f(size, kPlaneM);
  result.depth = cv::Mat1f(size);
  result.albedo = cv::Mat3f(size);
  result.uncertainty = cv::Mat3f(size, cv::Vec3f(1e-4f, 0.01f, 8));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double u = (x - 79.5) / 25, v = (y - 59.5) / 25;
      result.depth(y, x) = kPlaneM - kBumpM * static_cast<float>(std::exp(-(u * u + v * v) / 2));
      result.albedo(y, x) =
          (x / 20 + y / 20) % 2 == 0 ? cv::Vec3f(1.6f, 0.4f, 0.4f) : cv::Vec3f(0.4f, 1.6f, 1.6f);
    }
  }
  normals_from_depth(result.camera, result.depth).convertTo(result.normals, CV_32F);
  for (int i = 1; i <= 5; ++i) {
    IterationReport report;
    report.index = i;
    report.energy = 10.0 / i;
    report.depth_change_mm = 1.0 / (i * i);
    result.iterations.push_back(report);
  }
  result.termination = Termination::converged;
  result.message = "settled after 5 iterations";
  return result;
}

/// The same as a scene.
inline Scene bump_scene() {
  const RefineResult result = bump_result();
  Scene scene;
  scene.title = "bump";
  scene.layers.push_back({LayerKind::preprocessed, result.camera, result.initial_depth, {}});
  scene.layers.push_back({LayerKind::refined, result.camera, result.depth, result.normals});
  scene.albedo = result.albedo;
  scene.uncertainty = result.uncertainty;
  scene.iterations = result.iterations;
  scene.message = result.message;
  return scene;
}

}  // namespace rakelight::test
