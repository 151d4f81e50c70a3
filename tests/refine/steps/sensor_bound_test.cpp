// SPDX-FileCopyrightText: 2026 The Rakelight authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine/steps/sensor_bound.h"

#include <gtest/gtest.h>

namespace rakelight {
namespace {

constexpr double kNoise = 2e-3;

/// A plane of 40 x 10 pixels whose left four columns had no reading.
RefineProblem half_read_plane() {
  RefineProblem problem;
  problem.grid = make_pixel_grid({40, 10, 50, 50, 20, 5, {}}, cv::Mat1b(10, 40, uchar{255}));
  problem.sensor.inpainted = cv::Mat1b(10, 40, uchar{0});
  problem.sensor.inpainted.colRange(0, 4).setTo(255);
  problem.prior.start = Eigen::VectorXd::Zero(problem.grid.size());
  problem.depth_noise = kNoise;
  return problem;
}

TEST(SensorBound, KeepsCorrectionsBelowTheNoiseWhereThereWasNoReading) {
  const RefineProblem problem = half_read_plane();
  const Eigen::VectorXd moved = Eigen::VectorXd::Constant(problem.grid.size(), 10 * kNoise);
  const Eigen::VectorXd bounded = bounded_by_noise(problem, moved, false);
  EXPECT_LT(bounded[problem.grid.index(5, 2)], kNoise);
  EXPECT_LT(bounded[problem.grid.index(5, 6)], 2 * kNoise);
  EXPECT_DOUBLE_EQ(bounded[problem.grid.index(5, 39)], 10 * kNoise);
}

TEST(SensorBound, KeepsAllOfThemBelowItWhereAsked) {
  const RefineProblem problem = half_read_plane();
  const Eigen::VectorXd moved = Eigen::VectorXd::Constant(problem.grid.size(), -10 * kNoise);
  EXPECT_LT(bounded_by_noise(problem, moved, true).cwiseAbs().maxCoeff(), kNoise);
}

TEST(SensorBound, LeavesSmallCorrectionsAlone) {
  const RefineProblem problem = half_read_plane();
  const Eigen::VectorXd moved = Eigen::VectorXd::Constant(problem.grid.size(), 0.1 * kNoise);
  EXPECT_LT((bounded_by_noise(problem, moved, true) - moved).cwiseAbs().maxCoeff(), 0.001 * kNoise);
}

TEST(SensorBound, CountsReadingsMovedBeyondTheNoiseAndNoHoles) {
  const RefineProblem problem = half_read_plane();
  Eigen::VectorXd moved = problem.prior.start;
  for (int v = 0; v < 10; ++v) {
    moved[problem.grid.index(v, 0)] = 9 * kNoise;  // no reading
    moved[problem.grid.index(v, 10)] = 6 * kNoise;
    moved[problem.grid.index(v, 20)] = 4 * kNoise;
  }
  EXPECT_DOUBLE_EQ(share_beyond_noise(problem, moved), 10.0 / 360);
}

}  // namespace
}  // namespace rakelight
