// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "refine/steps/registration.h"
#include "refine/steps/robust_weights.h"
#include "stack/color_response.h"

namespace rakelight {
namespace {

constexpr double kMinimumLit = 3;  // images: unknowns of a normal and an albedo
constexpr double kMisfit = 2.5;    // residual of one image over the median of all
constexpr double kDrift = 0.01;    // ambient light, linear radiance
constexpr double kMovement = 3;    // depth noise deviations

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string sentence(const char* format, double number) {
  char text[256];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

void check_images(const Observations& images, const SurfaceState& state, QualityReport& report) {
  std::vector<double> scales;
  for (int i = 0; i < images.images; ++i) scales.push_back(residual_scale_of_image(images, state, i));
  const double usual = median(scales);
  for (int i = 0; i < images.images; ++i) {
    if (scales[static_cast<size_t>(i)] <= kMisfit * usual) continue;
    report.warnings.push_back(
        "frame " + std::to_string(images.frame_index[static_cast<size_t>(i)]) + " (light " +
        images.light_ids[static_cast<size_t>(i)] +
        ") does not fit the others: the object, the camera or the ambient light may have changed");
  }
  report.measures["worst_image_misfit"] =
      usual > 0 ? *std::max_element(scales.begin(), scales.end()) / usual : 1;
}

}  // namespace

Eigen::VectorXd lit_images(const Observations& images, const SurfaceState& state) {
  Eigen::VectorXd lit = Eigen::VectorXd::Zero(images.pixels);
  for (int i = 0; i < images.images; ++i) {
    const Lamp& lamp = state.lamps[static_cast<size_t>(i)];
    const float* weight = state.weight.data() + static_cast<size_t>(i) * static_cast<size_t>(images.pixels);
    for (int p = 0; p < images.pixels; ++p) {
      const LocalLight light = light_at(lamp, state.points.col(p), state.scene);
      if (lamp.second_order || (light.l * state.normals.col(p)).maxCoeff() > 0.0f)
        lit[p] += static_cast<double>(weight[p]);
    }
  }
  return lit;
}

QualityReport assess_quality(const RefineProblem& problem, const SurfaceState& state) {
  QualityReport report;
  const Eigen::VectorXd lit = lit_images(problem.images, state);
  const double few = (lit.array() < kMinimumLit).cast<double>().mean();
  report.measures["too_few_lit"] = few;
  if (few > 0.01 && problem.images.images > kMinimumLit) {
    report.warnings.push_back(sentence(
        "%.0f %% of the surface is lit in fewer than three images: its shape there rests on the sensor",
        100 * few));
  }
  check_images(problem.images, state, report);
  return report;
}

std::vector<std::string> recording_warnings(const LightStack& stack, const SensorDepth& sensor) {
  std::vector<std::string> warnings;
  cv::Mat3f first_dark;
  for (const Frame& frame : stack.frames) {
    if (!frame.light && !frame.color.empty()) {
      const cv::Mat3f dark = linear_color(stack, frame);
      if (first_dark.empty()) first_dark = dark;
      const cv::Scalar drift = cv::mean(dark - first_dark);
      const double most = std::max({std::abs(drift[0]), std::abs(drift[1]), std::abs(drift[2])});
      if (most > kDrift)
        warnings.push_back(sentence("ambient light drifted by %.3f of full scale between dark frames", most));
    }
    if (frame.depth.empty() || sensor.frames < 2) continue;
    std::vector<double> apart;
    const cv::Mat1f depth = registered_depth(stack, frame);
    for (int v = 0; v < depth.rows; ++v) {
      for (int u = 0; u < depth.cols; ++u) {
        const double difference = static_cast<double>(depth(v, u) - sensor.measured(v, u));
        if (!std::isnan(difference)) apart.push_back(difference);
      }
    }
    const double shift = std::abs(median(std::move(apart)));
    if (shift > kMovement * sensor.noise_m)
      warnings.push_back(
          "depth frame " + std::to_string(frame.index) +
          sentence(" lies %.1f mm from the others: the object or the camera may have moved", 1e3 * shift));
  }
  return warnings;
}

}  // namespace rakelight
