// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/sensor_bound.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace rakelight {
namespace {

constexpr double kOutlying = 5;  // deviations
constexpr double kReach = 8;     // depth pixels from a hole that it is felt

/// 255 where the sensor has a reading.
cv::Mat1b readings(const RefineProblem& problem) {
  cv::Mat1b image(problem.grid.index.size(), uchar{0});
  for (const cv::Point& at : problem.grid.pixels)
    image(at) = problem.sensor.inpainted(at.y / problem.scale, at.x / problem.scale) != 0 ? 0 : 255;
  return image;
}

}  // namespace

double share_beyond_noise(const RefineProblem& problem, const Eigen::VectorXd& zeta) {
  const cv::Mat1b read = readings(problem);
  double beyond = 0, count = 0;
  for (int p = 0; p < problem.grid.size(); ++p) {
    if (read(problem.grid.pixels[static_cast<size_t>(p)]) == 0) continue;
    ++count;
    if (std::abs(zeta[p] - problem.prior.start[p]) > kOutlying * problem.depth_noise) ++beyond;
  }
  return count > 0 ? beyond / count : 0;
}

Eigen::VectorXd bounded_by_noise(const RefineProblem& problem, const Eigen::VectorXd& zeta, bool everywhere) {
  cv::Mat1f distance;
  cv::distanceTransform(readings(problem), distance, cv::DIST_L2, cv::DIST_MASK_5);
  Eigen::VectorXd bounded = problem.prior.start;
  for (int p = 0; p < problem.grid.size(); ++p) {
    const auto far = static_cast<double>(distance(problem.grid.pixels[static_cast<size_t>(p)]));
    const double near = everywhere ? 1 : std::max(0.0, 1 - std::pow(far / (kReach * problem.scale), 2));
    const double c = zeta[p] - problem.prior.start[p];
    bounded[p] += c / std::hypot(1, near * c / problem.depth_noise);
  }
  return bounded;
}

}  // namespace rakelight
