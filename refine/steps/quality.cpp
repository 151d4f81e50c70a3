// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "refine/kernels/residual_sums.h"
#include "refine/steps/registration.h"
#include "refine/steps/robust_weights.h"
#include "refine/tiles.h"
#include "stack/color_response.h"
#include "stack/parallel.h"

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
  std::vector<double> scales(static_cast<size_t>(images.images));
  in_parallel(images.images,
              [&](int i) { scales[static_cast<size_t>(i)] = residual_scale_of_image(images, state, i); });
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

/// Median distance of a frame's depth to that of all together, metres.
double distance_to(const LightStack& stack, const Frame& frame, const SensorDepth& sensor) {
  std::vector<double> apart;
  const cv::Mat1f depth = registered_depth(stack, frame);
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const double difference = static_cast<double>(depth(v, u) - sensor.measured(v, u));
      if (!std::isnan(difference)) apart.push_back(difference);
    }
  }
  return std::abs(median(std::move(apart)));
}

}  // namespace

Eigen::VectorXd lit_images(const Observations& images, const SurfaceState& state) {
  Eigen::VectorXd lit(images.pixels);
  const std::vector<kernels::TileLamp> lamps = tile_lamps(state);
  for_each_tile(images, state, [&](Tile& tile) {
    kernels::TileRow sum{};
    for (int i = 0; i < images.images; ++i)
      kernels::add_lit_weights(tile.surface(), lamps[static_cast<size_t>(i)], tile.image(i), sum);
    for (int p = 0; p < tile.count(); ++p) lit[tile.begin() + p] = static_cast<double>(sum.at[p]);
  });
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
  std::vector<double> moved(stack.frames.size(), 0);
  if (sensor.frames > 1) {
    in_parallel(static_cast<int>(stack.frames.size()), [&](int k) {
      const auto at = static_cast<size_t>(k);
      if (!stack.frames[at].depth.empty()) moved[at] = distance_to(stack, stack.frames[at], sensor);
    });
  }
  std::vector<std::string> warnings;
  cv::Mat3f first_dark;
  for (size_t at = 0; at < stack.frames.size(); ++at) {
    const Frame& frame = stack.frames[at];
    if (!frame.light && has_color(frame)) {
      const cv::Mat3f dark = linear_color(stack, with_color(frame));
      if (first_dark.empty()) first_dark = dark;
      const cv::Scalar drift = cv::mean(dark - first_dark);
      const double most = std::max({std::abs(drift[0]), std::abs(drift[1]), std::abs(drift[2])});
      if (most > kDrift)
        warnings.push_back(sentence("ambient light drifted by %.3f of full scale between dark frames", most));
    }
    if (moved[at] > kMovement * sensor.noise_m)
      warnings.push_back("depth frame " + std::to_string(frame.index) +
                         sentence(" lies %.1f mm from the others: the object or the camera may have moved",
                                  1e3 * moved[at]));
  }
  return warnings;
}

}  // namespace rakelight
